"""Where the files of this Angen are: in a workspace, or beside the module of a wheel or of Debian's
package."""
import importlib.util
from functools import cache
from pathlib import Path

from angen_tools.common.failure import Failure


@cache
def _module_folder() -> Path | None:
    """The folder of the module angen, without importing it; None if there is none."""
    module = importlib.util.find_spec('angen')
    return Path(module.origin).parent if module is not None and module.origin else None


def _bundle() -> Path | None:
    """The folder with lib/ and share/ of a wheel or of Debian's package; None in a workspace."""
    folder = _module_folder()
    bundle = None if folder is None else folder / 'angen_files'
    return bundle if bundle is not None and bundle.is_dir() else None


def libraries() -> Path | None:
    """The folder of the simulator's libraries and built-in plug-ins; None if it is not found."""
    bundle, folder = _bundle(), _module_folder()
    if bundle is not None:
        return bundle / 'lib'
    return None if folder is None else folder.parents[1]  # it is lib/python3/dist-packages


def launch_file() -> Path | None:
    """The launch file of Debian's package, which `angen run` starts; a workspace has ./angen run
    for it."""
    bundle = _bundle()
    file = None if bundle is None else bundle / 'share/angen_sim/launch/angen.launch'
    return file if file is not None and file.exists() else None


def share(package: str) -> Path:
    """The folder of a package's files: worlds, page, configuration. Failure if it is not found."""
    bundle = _bundle()
    if bundle is not None and (bundle / 'share' / package).is_dir():
        return bundle / 'share' / package
    import rospkg
    try:
        return Path(rospkg.RosPack().get_path(package))
    except rospkg.ResourceNotFound:
        raise Failure(f'the package {package} is not found; use ./angen, or source '
                      'devel/setup.bash') from None
