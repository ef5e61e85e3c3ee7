"""Bodies of actors: bones, postures and gait, from species files.

A species is a file in `assets/species`. It draws everything in one standing pose, in actor axes (x forward, y left, z
up, origin on the ground below the middle of the body), in metres and degrees. Angles are right-handed: about x (roll),
y (positive turns nose or toes down), z (left).

category, material, speed_m_s
    category in the labels, a file in `assets/materials`, usual walking or driving speed
source
    source of each number, or that it is an estimate
wet_s
    of animals that come out of the water: shortest and longest time since then, of which each has its own
variants
    by name: `share` of a group's members; `size_range` relative to the drawing; `stretch`: by bone, scale factor of the
    bone and all its children, or three along x, y and z; `turn_deg`: angles that its bones have except when grazing or
    where a posture states others; `holds_deg`: angles that they have in every posture and move; `behaviours`: all that
    it does, if not everything
gait
    `leg_m`: height of the hip, which gives the stride length from the speed; `stance`: fraction of a stride that a foot
    is on the ground; `pitch`, `roll`: fraction of the ground's slope that the body follows
bones
    by name, parents first: `joint_m` where it turns, `parent` (none for a root), `shapes`; `mirror`: drawn on the left,
    present on both sides; `only`: the variants or the postures that have it; `stand*` is all that begin so
legs
    one entry per pair: `bones` from the hip down (upper, lower, foot, all with `mirror`), `toe_m` about which the foot
    rolls, `phases` of the stride at which the left and the right foot touch down, `lift_m`, `heel_deg` by which the
    heel has risen when the foot leaves the ground, `strike_deg` by which the toe is up when it touches down again, to
    roll over a heel `foot_m` behind the toe, `glide`: fraction of the foot's movement that the hip follows
wheels
    one entry per pair or single wheel: the `bone` and `radius_m`
moves
    swings of a `bone` about an `axis` by `deg`: `per_stride` times per stride, or once in `period_s`; `phase` in turns;
    `takes_turns`: both sides half a turn apart instead of mirrored; `only`
postures
    `graze` (how the head goes down), `lie`, `float`, `walk`, and `stand`, `sit`, `crouch`, `bend`; several for one
    behaviour are called like `sit_on_stool`. `turn_deg` by bone; `shift_m`: how far the hips move over feet that stay
    on the ground; `feet_m`: how far the left and the right foot move, ahead and to the left; or `sink_m`: how far the
    body comes down, without its feet; `rests_m`: half length and width of what it then rests on, whose slope it
    follows; `waterline_m`: how high the water reaches on a floating body
model
    a 3D model instead of `bones`, `legs`, `wheels` and `moves`: see assets/README.md

A shape is a solid (`geometry/solids.py`) with a `part` of the material, and optionally `mirror` (adds its mirror
image), `only`, and `patches`: a `part` each for triangles whose middle is in the box `from_m` to `to_m`, later ones
over earlier ones. Knees bend towards the side on which they are drawn, so hip, knee and ankle must not be collinear.
The lowest toe is placed on the ground. Bones overlap at their joints with rounded ends. A body has at most 4000
triangles.
"""
