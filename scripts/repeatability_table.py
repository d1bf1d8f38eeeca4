#!/usr/bin/env python3
"""The program's own table of repeatability from a cohort of pairs without a change between their scans.

    ostia compare --pairs unchanged.csv -o cohort
    scripts/repeatability_table.py cohort/cohort.json > libs/analysis/src/change/repeatability_table.h
"""
import json
import sys

SCOPES = ["lesion", "segment", "vessel", "patient"]
MEASURES = ["mld_mm", "mla_mm2", "stenosis_percent", "length_mm", "plaque_mm3", "low_attenuation_mm3", "fibrofatty_mm3", "fibrous_mm3", "calcified_mm3",
            "burden_percent", "remodelling_index", "fat_hu"]


def header(table, origin):
    def row(scope):
        found = [table.get(scope, {}).get(key, {"sd": 0.0, "share": 0.0}) for key in MEASURES]
        return "    {" + ", ".join(f"{{{one['sd']:.4g}, {one['share']:.4g}}}" for one in found) + "},"
    rows = "\n".join(row(scope) for scope in SCOPES)
    return f"""#pragma once
/// \\file Made by scripts/repeatability_table.py, not by hand (docs/methods/compare.md).

#include "ostia/analysis/repeatability.h"

namespace ostia::analysis {{

inline constexpr const char* repeatability_from = {json.dumps(origin)};
/// Standard deviation and share of the mean, by scope and measure.
// clang-format off
inline constexpr double repeatability_table[change_scope_count][change_measure_count][2] = {{
{rows}
}};
// clang-format on

}}  // namespace ostia::analysis
"""


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: repeatability_table.py COHORT.json [WHERE IT WAS MEASURED]")
    with open(sys.argv[1], encoding="utf-8") as file:
        table = json.load(file).get("repeatability")
    if not isinstance(table, dict):
        sys.exit(f"{sys.argv[1]}: no object \"repeatability\"; give the cohort.json of ostia compare --pairs")
    print(header(table, sys.argv[2] if len(sys.argv) == 3 else table.get("from", "")), end="")


if __name__ == "__main__":
    main()
