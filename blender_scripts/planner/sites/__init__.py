"""Settlements: camps, villages and posts, laid out by the rules of `assets/sites`.

A site is a file in `assets/sites`. `radius_m` is its usual size; distances from its middle (`ring`: least and largest)
are in radii. `objects` are rules, carried out in order; an object that finds no free position in 60 tries is left out.
An `object` is a structure or a plant, or a list of which each instance is one. `count` is its least and largest number.

no other key                                things anywhere in the `ring`
"beside": […], "share", "gap_m"             one beside a share of the things named, that far away
"row": {"step_m", "turn_deg"}               things nearly on a line along the site's heading, or across it
"loop": {"radius_m", "step_m", "gate_m"}    segments of a fence around free ground, uneven and round; `gaps`: share of
                                            them that is missing; `is_rectangle`: with four sides; `around`: around
                                            what stands there already

`faces` turns things: `middle`, `grid` (along the site's heading or across it) or any way. `ground` lists ground covers
made by people; where they overlap, the first one wins: a `disc` of so many radii, rectangles of `size_m`, or winding
`tracks` from the middle, which end in a point; `ragged_m` is how uneven a border is. No grass grows there, except on
the `fallow` share of rectangles, of which furrows, `furrow_m` apart, are left. Rectangles with furrows have four uneven
sides. Foot paths (`land/trails.py`) lead from a site to its neighbours, the road, the water and out into the land.
"""
