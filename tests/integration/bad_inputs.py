"""Every bad input that was tried on `convert`, and what it gets: the one table of them. test_bad_inputs.py runs it and
keeps README.md the same."""

from bad_configs import CONFIGS
from bad_exr import CHANNELS, FILES, HEADERS
from bad_manifests import MANIFESTS, SEQUENCES
from bad_pictures import CRYPTOMATTES, PICTURES

BAD_INPUTS = [*FILES, *HEADERS, *CHANNELS, *PICTURES, *CRYPTOMATTES, *MANIFESTS, *SEQUENCES, *CONFIGS]
