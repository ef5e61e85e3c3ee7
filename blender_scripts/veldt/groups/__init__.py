"""Who is in the scene, where, and what they do."""
