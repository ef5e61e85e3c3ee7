"""Bodies of actors: bones, postures and gait."""
