"""The setting of NumPy in the environment that the program gives to Blender and Python (io/system/child_process.h)."""

from pathlib import Path

_HAS_AVX512 = " avx512dq" in Path("/proc/cpuinfo").read_text(encoding="utf-8")
REPRODUCIBLE = {"NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512_SKX"} if _HAS_AVX512 else {}
