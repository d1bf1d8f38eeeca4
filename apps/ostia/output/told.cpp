#include "output/told.h"

#include "ostia/core/log.h"

#include <cstdio>

namespace ostia::app {

void tell(const std::string& kind, const ToldJson& facts, const std::string& line, bool as_json) {
  if (!as_json) {
    std::puts(line.c_str());
    return;
  }
  ToldJson out{{"v", 1}, {"kind", kind}};
  out.update(facts);
  out["warnings"] = ToldJson::array();
  for (const std::string& warning : core::heard_warnings())
    out["warnings"].push_back(core::redacted(warning));
  std::puts(out.dump(2).c_str());
}

ToldJson json_of(const std::vector<pipeline::UnreachedPlace>& places) {
  const auto point = [](const geometry::Vec3& p) { return ToldJson::array({p.x(), p.y(), p.z()}); };
  ToldJson all = ToldJson::array();
  for (const pipeline::UnreachedPlace& one : places)
    all.push_back(
        {{"place", point(one.place)}, {"reached", point(one.reached)}, {"missing_mm", one.missing_mm}});
  return all;
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace ostia::app
