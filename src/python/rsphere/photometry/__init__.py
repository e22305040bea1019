"""Luminaires: IES LM-63 and EULUMDAT files, and what they are in a scene.

    lamp = rsphere.photometry.read_luminaire("panel.ies")
    lamp.lumens(), lamp.watts, lamp.candela
    rsphere.photometry.UgrTable(lamp).values
"""
from .intensities import Photometry
from .luminaire_file import read_luminaire
from .ugr_table import UgrTable

__all__ = ["Photometry", "UgrTable", "read_luminaire"]
