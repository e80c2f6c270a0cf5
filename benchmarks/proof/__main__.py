"""Write docs/check/proof.md, its pictures and its summary, and docs/understand/thesis/agreement.md (`make proof`)."""

import warnings
from pathlib import Path

from benchmarks.proof import crossing, discs, locomotive, roller, steering, thesis
from benchmarks.tables import table
from contact.errors import ModelWarning, PlausibilityWarning

DOCS = Path(__file__).resolve().parents[2] / "docs"

#: Case, source, module with its section, and our verdict.
CASES = (
    ("Equivalent conicity", "EN 15302:2008 and 2021, annex", steering, "Good"),
    ("Locomotive, friction that falls when hot", "CONTACT's Eurosprinter", locomotive, "Good; CONTACT is 11 % too hot"),
    ("Roller rig, measured profiles, a layer", "CONTACT's test bank", roller, "Good, at CONTACT's contact points"),
    ("Crossings", "CONTACT 25.1, set F", crossing, "Forces good; pressures of strips poor on rough rails"),
    ("Twin disc, flash temperature", "Lewis and Dwyer-Joyce 2004", discs, "Too hot; disc sizes recalled"),
)

NOT_FOUND = """## Not found

Looked for in stored copies of web pages (only their beginnings), documentation, code and threads, in November 2026.

| wanted | found |
| --- | --- |
| Manchester contact benchmark (2008) by other programs | no numbers. CONTACT's are in [its page](manchester.md) |
| finite elements against CONTACT on it (Vehicles 7(3):104, 2025) | abstract and introduction of the article, no table |
| Manchester vehicle benchmark | masses in public code; the contents of Universal Mechanism's chapter on it |
| creep curves in the field (Polach, Harrison, TU Berlin) | abstracts; Polach (Wear 258, 2005) up to its equations, no points |
| laboratory creep curves (V-Track, Lubricants 13(7):287) | abstract |
| switches and crossings (HAL hal-04225767), Bezin's benchmark | abstract |
| wear regimes of R8T | nothing |
"""


def summary() -> tuple[str, str]:
    """Return the summary table, which pages of any folder can include, and all sections."""
    rows, texts = [], []
    for title, source, module, verdict in CASES:
        agreement, text = module.section()
        rows.append([title, source, agreement, verdict])
        texts.append(text)
    claims = f"{len(thesis.CLAIMS)} claims of its text"
    rows.append(["The thesis, what its text says", "KTH 2016", claims, "Good; its curves could not be read"])
    return table(["case", "source", "agreement", "verdict"], rows), "\n".join(texts)


def page(rows: str, texts: str) -> str:
    """Return the text of docs/check/proof.md."""
    return f"""# Proof: published cases

`make proof` writes this page from the numbers in `reference/`.

{rows}
[Agreement with the thesis](../understand/thesis/agreement.md), the [Manchester contact benchmark](manchester.md),
[creep forces on ellipses](statistics.md), the [map of methods](method_map.md) and [real time](real_time.md) have their own
pages.

{texts}
{NOT_FOUND}"""


if __name__ == "__main__":
    for kind in (PlausibilityWarning, ModelWarning):  # of large slips, and of methods that are shown for their errors
        warnings.simplefilter("ignore", kind)
    folder = DOCS / "check" / "proof"
    folder.mkdir(exist_ok=True)
    discs.draw(folder / "twin_disc.png")
    locomotive.draw(folder / "locomotive.png")
    roller.draw(folder / "roller_rig.png")
    crossing.draw(folder / "crossing.png")
    rows, texts = summary()
    (DOCS / "check" / "proof.md").write_text(page(rows, texts), encoding="utf-8")
    (folder / "summary.txt").write_text(rows, encoding="utf-8")
    (DOCS / "understand" / "thesis" / "agreement.md").write_text(thesis.page(), encoding="utf-8")
