"""Entries of the workbench's menu and toolbar, each making one object from what is selected."""

import FreeCAD
import FreeCADGui

import keyline_objects

# kind, entry, what to select, how many
ENTRIES = (
    ("Curve", "Curve from sketch", "A sketch of lines end to end: two are a segment's handles, more a spline's points", 1),
    ("Fair", "Fair", "A wire, sketch or polyline of measured points", 1),
    ("Blend", "Blend", "Two wires: from the end of the first to the start of the second", 2),
    ("Comb", "Curvature comb", "A wire", 1),
    ("Zebra", "Zebra", "A face", 1),
    ("Value", "Aesthetic value", "A wire of one edge (CAV) or a face (SAV)", 1),
)


class Make:
    def __init__(self, kind, entry, selection, count):
        self.kind, self.entry, self.selection, self.count = kind, entry, selection, count

    def GetResources(self):
        return {"MenuText": self.entry, "ToolTip": self.selection}

    def chosen(self):
        """Each object with the names of its faces and edges that are selected."""
        return [(s.Object, list(s.SubElementNames)) for s in FreeCADGui.Selection.getSelectionEx()]

    def IsActive(self):
        return len(self.chosen()) >= self.count

    def Activated(self):
        document = FreeCAD.ActiveDocument
        document.openTransaction(f"Keyline: {self.entry}")
        keyline_objects.make(self.kind, *self.chosen()[: self.count])
        document.commitTransaction()
        document.recompute()


def add():
    """Makes the commands known; their names in order."""
    for kind, entry, selection, count in ENTRIES:
        FreeCADGui.addCommand(f"Keyline_{kind}", Make(kind, entry, selection, count))
    return [f"Keyline_{entry[0]}" for entry in ENTRIES]
