"""Draw how an FMU is imported and wired: `python docs/pictures/wiring.py` writes SVGs for Simulink, Simpack and Modelica."""

from html import escape
from pathlib import Path

FOLDER = Path(__file__).parent
WIDTH, HEIGHT = 640, 330
INK, FAINT, FILL, FMU = "#22262b", "#6d747d", "#eef2f6", "#dcebf7"

#: File → steps of the import, vehicle, what makes inputs of its signals, the FMU, what makes forces of its outputs.
DRAWINGS = {
    "simulink": (
        (
            "Library Browser:\nSimulink Extras,\nFMU Import, FMU",
            "FMU name:\ndist/native/\nWheelRailPair.fmu",
            "mode: ME or CS;\nfmudialog.\ncreateBusType(gcb)",
        ),
        ("your vehicle", "integrators, masses"),
        ("Bus Creator", "pose, velocity, load"),
        ("FMU WheelRailPair", "one for each wheel"),
        ("Bus Selector", "force.y, moment.z, …"),
    ),
    "simpack": (
        (
            "native FMU for\nCS, FMI 2.0:\nWheelRailPair.fmu",
            "FMI slave in the\nmodel, one for\neach wheel",
            "communication\nstep ≤ 0.2 ms\n(10 m/s)",
        ),
        ("Simpack's vehicle", "markers of the wheelset"),
        ("sensors, track frame", "y, z, roll, yaw, rates"),
        ("FMU WheelRailPair", "co-simulation"),
        ("applied force", "force, moment, turned back"),
    ),
    "modelica": (
        (
            "Dymola: File, Open,\nImport FMU;\nOMEdit: FMI, Import",
            "choose model\nexchange,\nFMI 2.0",
            "drag the new\nclass into the\nmodel",
        ),
        ("bodies and joints", "Modelica.Mechanics"),
        ("turn the frame", "x forward, y right, z down"),
        ("FMU WheelRailPair", "model exchange"),
        ("WorldForceAndTorque", "turned back"),
    ),
}


def box(x: float, y: float, width: float, height: float, lines: tuple[str, ...], fill: str = FILL) -> str:
    """Return a rounded box with centred lines of text; the first one of two is bold."""
    middle, top, named = x + width / 2, y + height / 2 - 7.5 * (len(lines) - 1) + 4, len(lines) == 2
    texts = ""
    for k, line in enumerate(lines):
        look = f'fill="{INK}" font-weight="600"' if named and not k else f'fill="{FAINT if named else INK}"'
        texts += f'<text x="{middle:g}" y="{top + 15 * k:g}" text-anchor="middle" font-size="12" {look}>{escape(line)}</text>'
    return f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="6" fill="{fill}" stroke="{FAINT}"/>{texts}'


def arrow(*points: tuple[float, float]) -> str:
    """Return a line through the points with a head at its end."""
    path = " L".join(f"{x:g},{y:g}" for x, y in points)
    return f'<path d="M{path}" fill="none" stroke="{INK}" stroke-width="1.4" marker-end="url(#head)"/>'


def drawing(name: str) -> str:
    """Return the SVG of one tool: the import in a row, the loop of signals under it."""
    steps, vehicle, inwards, fmu, outwards = DRAWINGS[name]
    parts = [f'<text x="12" y="22" font-size="13" font-weight="600" fill="{INK}">Import</text>']
    for k, step in enumerate(steps):
        parts.append(box(12 + 210 * k, 34, 186, 66, tuple(step.split("\n"))))
        parts += [arrow((198 + 210 * k, 67), (220 + 210 * k, 67))] if k < len(steps) - 1 else []
    parts.append(f'<text x="12" y="136" font-size="13" font-weight="600" fill="{INK}">Wiring</text>')
    parts += [box(12, 204, 160, 50, vehicle), box(232, 150, 176, 50, inwards), box(468, 204, 160, 50, fmu, FMU)]
    parts += [box(232, 258, 176, 50, outwards)]
    parts += [arrow((92, 204), (92, 175), (230, 175)), arrow((408, 175), (548, 175), (548, 202))]
    parts += [arrow((548, 254), (548, 283), (410, 283)), arrow((232, 283), (92, 283), (92, 256))]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="system-ui, sans-serif">'
        '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
        f'<path d="M0,0 L8,4 L0,8 z" fill="{INK}"/></marker></defs>'
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>{"".join(parts)}</svg>\n'
    )


if __name__ == "__main__":
    for name in DRAWINGS:
        (FOLDER / f"wiring_{name}.svg").write_text(drawing(name), encoding="utf-8")
