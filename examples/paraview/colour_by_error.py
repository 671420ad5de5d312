"""Colours Blendwright's .vtp files by a joint error: gap, then angle, then curvature jump.

As a ParaView macro (Macros > Import New Macro...): acts on the files that are open; press it again for the next
error. From a terminal, without a window:

    pvpython examples/paraview/colour_by_error.py out/*.vtp --show angle -o angle.png

The scale is logarithmic over five decades below the worst value; the title tells that value and the tolerance.
"""
import argparse
import math
import sys

from paraview.simple import *  # what ParaView calls its scripting interface

ERRORS = {"gap": "gap", "angle": "angle_deg", "curvature": "curvature_jump"}  # word: start of the array's name
DECADES = 5
TITLE = "Blendwright error"


def array_of(source, start):
    """The point array whose name starts so: the rest is its unit, "gap [mm]"."""
    for name in source.PointData.keys():
        if name == start or name.startswith(start + " ["):
            return name
    return None


def unit_of(array):
    if array.endswith("]"):
        return " " + array[array.rindex("[") + 1:-1]
    return " deg" if array.endswith("_deg") else ""


def tolerance_of(sources, word):
    """The least tolerance among the facts of the files, or None."""
    wanted = ": tolerance of " + {"curvature": "curvature jump"}.get(word, word)
    found = [source.FieldData[name].GetRange(0)[0] for source in sources for name in source.FieldData.keys()
             if wanted in name]
    return min(found) if found else None


def is_joint(source):
    """Blends and trimlines, whose errors were measured where they are drawn; primaries only repeat the nearest."""
    return array_of(source, "fit_deviation") or "closed" in source.CellData.keys()


def colour(sources, word):
    """Colours `sources`, which have the error, in the active view (primaries stay grey), and hides other scales."""
    view = GetActiveViewOrCreate("RenderView")
    array = array_of(sources[0], ERRORS[word])
    worst = max(source.PointData[array].GetRange(0)[1] for source in sources)
    for source in sources:
        shown = Show(source, view)
        shown.LineWidth = 4.0
        ColorBy(shown, ("POINTS", array) if is_joint(source) else None)
        if not is_joint(source):
            shown.DiffuseColor = shown.AmbientColor = [0.75, 0.75, 0.75]
    HideUnusedScalarBars(view)
    table = GetColorTransferFunction(array)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.UseLogScale = 0
    bar = GetScalarBar(table, view)
    bar.UseCustomLabels = 0
    if worst > 0.0:
        top = math.floor(math.log10(worst))
        bar.UseCustomLabels, bar.AddRangeLabels = 1, 0
        bar.CustomLabels = [10.0 ** k for k in range(top - DECADES + 1, top + 1)]
        bar.LabelFormat = bar.RangeLabelFormat = "%.0e"
        table.RescaleTransferFunction(worst * 10.0 ** -DECADES, worst)
        table.MapControlPointsToLogSpace()
        table.UseLogScale = 1
    bar.Title = word if word != "curvature" else "curvature jump"
    bar.ComponentTitle = "(%s)" % unit_of(array).strip()
    bar.WindowLocation, bar.Visibility = "Lower Right Corner", 1
    tolerance = tolerance_of(sources, word)
    text = "worst %s %.2g%s" % (bar.Title, worst, unit_of(array))
    if tolerance is not None:
        text += " (tolerance %.2g%s)" % (tolerance, unit_of(array))
    title = FindSource(TITLE) or Text(registrationName=TITLE)
    title.Text = text
    words = Show(title, view)
    words.WindowLocation = "Upper Center"
    words.FontSize = 18
    view.ResetCamera()
    Render(view)
    return text


def next_error(sources):
    """The error after the one that is shown, or the first."""
    order = list(ERRORS)
    shown = GetDisplayProperties(sources[0]).ColorArrayName[1]
    for i, word in enumerate(order):
        if FindSource(TITLE) and shown and shown == array_of(sources[0], ERRORS[word]):
            return order[(i + 1) % len(order)]
    return order[0]


def with_errors(sources):
    found = []
    for source in sources:
        source.UpdatePipeline()
        if hasattr(source, "PointData") and all(array_of(source, start) for start in ERRORS.values()):
            found.append(source)
    return found


def main():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("files", nargs="*", help=".vtp files; none: those that are open in ParaView")
    asked.add_argument("--show", choices=list(ERRORS))
    asked.add_argument("-o", "--output", help="picture to write, .png")
    options = asked.parse_args(sys.argv[1:] if sys.argv and sys.argv[0].endswith("colour_by_error.py") else [])
    sources = [XMLPolyDataReader(registrationName=f, FileName=[f]) for f in options.files] or list(
        GetSources().values())
    sources = with_errors(sources)
    if not sources:
        sys.exit("colour_by_error: no open file has the joint errors; open the .vtp files that `blendwright blend` wrote")
    if options.output:
        GetActiveViewOrCreate("RenderView").ViewSize = [1280, 960]  # sizes of letters are in its pixels
    text = colour(sources, options.show or next_error(sources))
    if options.output:
        view = GetActiveView()
        camera = view.GetActiveCamera()
        camera.SetPosition([f + d for f, d in zip(camera.GetFocalPoint(), (1.0, -1.2, 0.8))])
        camera.SetViewUp(0.0, 0.0, 1.0)
        view.ResetCamera()
        SaveScreenshot(options.output, view, ImageResolution=[1280, 960], OverrideColorPalette="WhiteBackground")
        print(text)


main()
