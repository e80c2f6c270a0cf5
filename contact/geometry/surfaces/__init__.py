"""Surfaces that change along the track or around the wheel: crossings, wheel flats, polygons (docs/use/surfaces.md)."""

from contact.geometry.surfaces.deviation import Deviation, Flat, Polygon, Wave
from contact.geometry.surfaces.pair import SurfacePair, SurfacePatch
from contact.geometry.surfaces.surface import RailSurface, WheelSurface

__all__ = ["Deviation", "Flat", "Polygon", "RailSurface", "SurfacePair", "SurfacePatch", "Wave", "WheelSurface"]
