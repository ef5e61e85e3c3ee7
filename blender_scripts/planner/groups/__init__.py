"""Groups of actors: members, positions and behaviours."""
