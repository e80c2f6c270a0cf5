"""Contact search: profiles and a pose in, patches and their separations out."""
