"""A plug-in that edits: cross-sections are drawn anew as circles, wider than they are."""
import numpy as np

import ostia
from ostia import plugin

AROUND = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
FROM_ENDS_MM = 1.5  # what is nearer to an end is the cap's


@plugin.edits("Widen the wall", version="1.0")
def widen_wall(
    given: plugin.Given, vessel: plugin.Vessel = -1, by_mm: float = 0.2, step_mm: float = 1.0, narrow_alone: bool = False,
) -> list[str]:
    """Draws a vessel's cross-sections anew as circles, wider by so many mm; only where it is narrower than usual, if you like."""
    axis = given.tree.axis(vessel)
    profile = ostia.lumen_profile(given.model, vessel)
    radius = np.interp(axis.abscissa, profile.s_mm[profile.found], profile.diameter_mm[profile.found]) / 2
    usual = np.median(radius)
    edits = []
    last = given.model.own_from_mm(vessel)
    for i, s in enumerate(axis.abscissa):
        if s < last + step_mm or s > axis.length - FROM_ENDS_MM or (narrow_alone and radius[i] >= usual):
            continue
        last = s
        normal, binormal = axis.frames[i, 1], axis.frames[i, 2]
        circle = axis.points[i] + (radius[i] + by_mm) * (np.outer(np.cos(AROUND), normal) + np.outer(np.sin(AROUND), binormal))
        edits.append(plugin.edit("section.contour", vessel=vessel, s_mm=float(s), eps_mm=2.0 * step_mm, closed=True, points=circle))
        given.progress(s / axis.length, "cross-sections")
    return edits
