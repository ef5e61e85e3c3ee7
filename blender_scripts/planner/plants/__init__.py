"""Plants, and other objects that stand or lie about: placement and shapes.

A plant or another static object is a file in `assets/plants`.

form          how it is drawn (`plant_shapes.FORMS`), at exactly `height_m` and `crown_diameter_m`; of the forms
              `umbrella` and `many_stemmed`, stems and limbs are the part `wood` of its material; `leaves` facets of
              about `leaf_m` are clusters of leaves along twigs
scale_range   sizes of instances, relative to that
foot_m        radius that no other plant stands on
spacing_m     least distance to the next plant of its kind
clearance_m   least distance to walking actors
patch_m       size of rich and poor patches
clump_m       radius of clumps, in which three quarters of the plants stand where there is room, 0 (none) by default
slope_deg     two slopes: full density up to the first, none above the second
cover_m2      ground it hides from above, for the budget of physical terms
model         a 3D model instead of `form`: see assets/README.md

Instead of a `form`, it can have `shapes` and `materials` as a structure has. A structure is a file in
`assets/structures`. The rules of a site place it.

shapes        solids (`geometry/solids.py`) in m, x along its front, z up, the origin on the ground, each with a `part`;
              `share`: of the variants that have it, 1 by default; `ragged`: how uneven its outline is, seen from
              above, as a share of its reach, 0 by default
variants      number of forms, 1 by default
proportions   largest relative change of a variant's length, width and height, 0 by default
scale_range   sizes, relative to the drawn one, which all have by default
materials     by part: a file in `assets/materials`, or `[material, part]` for a part of it; the first is what is seen
              from above
foot_m        radius that nothing else of the site stands on, and no plant grows on
clearance_m   least distance to walking actors, from there
cover_m2      ground it hides from above, for the budget of physical terms
"""
