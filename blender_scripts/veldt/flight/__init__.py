"""How the camera is carried about and where it looks."""
