"""Write docs/check/proof.md, its pictures and its summary, and docs/understand/thesis/agreement.md (`make proof`)."""

import warnings
from pathlib import Path

from benchmarks.proof import crossing, discs, locomotive, roller, steering, thesis
from benchmarks.tables import fill, table
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
    fill(DOCS / "check" / "proof.md", {"summary": rows, "sections": texts})
    (folder / "summary.txt").write_text(rows, encoding="utf-8")
    fill(DOCS / "understand" / "thesis" / "agreement.md", {"claims": thesis.claims()})
