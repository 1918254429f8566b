"""Keyline's workbench needs nothing before FreeCAD has a window."""
