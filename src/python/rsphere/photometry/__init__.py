"""Luminaires: IES LM-63 and EULUMDAT files, and what they are in a scene.

    lamp = rsphere.photometry.read_luminaire("panel.ies")
    lamp.lumens(), lamp.watts, lamp.candela
"""
from .intensities import Photometry
from .luminaire_file import read_luminaire

__all__ = ["Photometry", "read_luminaire"]
