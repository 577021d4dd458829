"""angen import: reads a plan of any known kind and writes a world."""
import argparse
from pathlib import Path
from typing import Any

from angen_apps.imports.picture import ENDINGS, is_map, read_map, read_picture
from angen_apps.imports.rmf import read_rmf
from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.model import Plan
from angen_apps.plan.writer import write_world, written
from angen_apps.residents.ways import ways_in
from angen_tools.common.failure import Failure
from angen_tools.common.limited import run_limited

SHOWN = 20  # remarks


def read_plan(path: Path, args: argparse.Namespace) -> Plan:
    """The plan of a file, by its ending."""
    if not path.exists():
        raise Failure(f'{path}: there is no such file')
    ending = path.suffix.lower()
    for option, given in (('--things', args.things), ('--meshes', args.meshes)):
        if given and ending in (*ENDINGS, '.yaml', '.yml'):
            raise Failure(f'{path}: has no furniture of Sweet Home 3D, which {option} is for')
    if ending in ENDINGS:
        if args.scale is None:
            raise Failure(f'{path}: is a picture; give --scale METERS_A_PIXEL, such as 0.05')
        return read_picture(path, args.scale, args.doors)
    if ending in ('.yaml', '.yml'):
        return read_map(path, args.doors) if is_map(path) else read_rmf(path)
    return read_sweethome(path, args.things, args.meshes)


def import_home(path: Path, output: Path, args: argparse.Namespace) -> dict[str, Any]:
    """Writes the world; returns the result: counts, and remarks."""
    plan = run_limited(path, read_plan, path, args)
    counts = write_world(plan, output, args.sensors)
    done = written(output, counts)
    try:
        ways = ways_in(output)
    except Failure as failure:
        ways = [f'people find no ways: {failure}']
    remarks = [*ways[1:], *plan.remarks]
    lines = [done['text'], *ways[:1], *(f'remark: {remark}' for remark in remarks[:SHOWN])]
    if len(remarks) > SHOWN:
        lines.append(f'and {len(remarks) - SHOWN} more remarks')
    return {**done, 'remarks': remarks, 'text': '\n'.join(lines)}
