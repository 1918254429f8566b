"""Keyline's workbench: FreeCAD runs this when it starts, with its names already there."""

import FreeCADGui


class KeylineWorkbench(FreeCADGui.Workbench):
    MenuText = "Keyline"
    ToolTip = "Aesthetic curves: drawn, faired, blended, judged"

    def Initialize(self):
        import keyline_commands

        commands = keyline_commands.add()
        self.appendToolbar("Keyline", commands)
        self.appendMenu("Keyline", commands)

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(KeylineWorkbench())
