#!/bin/sh
# What ./run fresh runs if no command is given: a whole build, one frame of each of the demo's two clips, one more
# rendered by a real Blender, the program's own view of the machine, and programs that use the installed library.
set -eu
./run build
./run demo --set 'clips[0].frames=1' 'clips[1].frames=1'
build/release/bin/veldt generate configs/demo.json --engine blender --out build/demo_blender --clips winter_zigzag_61m \
  --set 'clips[0].frames=1' sensor.preset=airsim_w
build/release/bin/veldt doctor
build/release/bin/veldt validate build/demo
tests/fresh/consumer.sh
