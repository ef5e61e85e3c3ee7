"""The baked scene: everything a renderer draws, as flat arrays in files. Contract: configs/schema/*.schema.json."""
