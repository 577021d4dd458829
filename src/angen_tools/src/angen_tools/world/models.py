"""Finds models and their parts, where the simulator finds them."""
import os
from functools import cache
from pathlib import Path

from lxml import etree

from angen_tools.common.installed import share
from angen_tools.world import sdf


@cache
def worlds_models() -> Path:
    """worlds/models of this Angen."""
    return share('angen_sim') / 'worlds/models'


def building() -> Path:
    """The world that commands use unless another one is given."""
    return worlds_models().parent / 'angen.world'


def folders() -> list[Path]:
    """The folders in which models are searched."""
    return [*(Path(folder) for variable in ('ANGEN_MODEL_PATH', 'GAZEBO_MODEL_PATH')
              for folder in os.environ.get(variable, '').split(':') if folder), worlds_models()]


def addresses() -> list[str]:
    """The model:// addresses that are found."""
    return sorted({f'model://{file.parent.name}' for folder in folders()
                   for file in folder.glob('*/model.sdf')})


def find(uri: str) -> Path | None:
    """The SDF file of a model:// address or path; None if there is none."""
    if uri.startswith('model://'):
        places = [folder / uri.removeprefix('model://') for folder in folders()]
    else:
        places = [Path(uri.removeprefix('file://'))]
    for place in places:
        if place.exists():
            return place / 'model.sdf' if place.is_dir() else place
    return None


def collisions(world: etree._Element, link: str) -> list[str]:
    """Names of the collisions of MODEL::LINK in a saved world; empty if they are not found."""
    model_name, link_name = link.split('::', 1)
    model = _model_of(world, model_name)
    return [collision.get('name', '') for part in _children(model, 'link')
            if part.get('name') == link_name for collision in part.iterfind('collision')]


def seat_of(world: etree._Element, name: str) -> tuple[float, ...] | None:
    """x, y, z of the middle of the top of a model's box `seat_collision` in the model's frame, and
    its depth along x, in m; None if the model of a saved world has none.
    """
    for link in _children(_model_of(world, name), 'link'):
        for collision in link.iterfind("collision[@name='seat_collision']"):
            size = collision.findtext('geometry/box/size', '').split()
            if len(size) != 3:
                return None
            places = [sdf.parse_pose(part.findtext('pose', '0 0 0')) for part in (link, collision)]
            x, y, z = (sum(place[k] for place in places) for k in range(3))
            return x, y, z + float(size[2]) / 2, float(size[0])
    return None


def _children(model: etree._Element | None, tag: str) -> list[etree._Element]:
    return [] if model is None else model.findall(tag)


def _read_model(include: etree._Element) -> etree._Element | None:
    """The <model> that an <include> names, with the parts of those that it includes by merge."""
    file = find(include.findtext('uri', '').strip())
    model = sdf.read(file).find('model') if file and file.exists() else None
    if model is not None:
        for merged in model.findall("include[@merge='true']"):
            inner = _read_model(merged)
            model.extend([] if inner is None else list(inner))
    return model


def _model_of(world: etree._Element, name: str) -> etree._Element | None:
    """The <model> of that name, read from its file where the world includes it."""
    for entry in world.iterfind('world/*'):
        model = entry
        if entry.tag == 'include':
            model = _read_model(entry)
        if model is None or model.tag != 'model':
            continue
        if (entry.findtext('name') or model.get('name', '')).strip() == name:
            return model
    return None
