"""The baked scene: all renderer input, as flat arrays in files. Contract: configs/schema/*.schema.json."""
