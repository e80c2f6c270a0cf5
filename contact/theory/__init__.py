"""Closed forms and tables of the literature: Hertz, Kalker's linear theory, his table of creep forces."""
