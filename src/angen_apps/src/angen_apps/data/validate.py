"""Checks a home's data: recomputes what follows from truth, track, states and layout."""
from __future__ import annotations

from pathlib import Path

from angen_apps.data.checks import files, labels, places, sensors
from angen_apps.data.tables import homes
from angen_apps.data.written import Findings, Written

SHOWN = 3  # findings of a kind that are listed


def validate_all(folder: Path) -> tuple[Findings, dict[str, dict[str, float]]]:
    """Checks the homes of an output folder, and their list; the shares are by home."""
    findings, shares, found = Findings(), {}, homes(folder)
    for home in found:
        own = validate(home)
        findings.add(own, home.name)
        shares[home.name] = own.shares
    files.check_folder(findings, folder, found)
    return findings, shares


def validate(folder: Path) -> Findings:
    """Checks one home."""
    findings = Findings()
    home = Written(folder)
    for check in (files.check, places.check, labels.check, sensors.check):
        check(findings, home)
    return findings
