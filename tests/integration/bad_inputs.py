"""The table of all bad inputs for `convert` and their results. test_bad_inputs.py runs it and checks that README.md
lists the same."""

from bad_configs import CONFIGS
from bad_exr import CHANNELS, FILES, HEADERS
from bad_manifests import MANIFESTS, SEQUENCES
from bad_pictures import CRYPTOMATTES, PICTURES

BAD_INPUTS = [*FILES, *HEADERS, *CHANNELS, *PICTURES, *CRYPTOMATTES, *MANIFESTS, *SEQUENCES, *CONFIGS]
