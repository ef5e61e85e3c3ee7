"""Groups of actors: who is in the scene, where, and what they do."""
