"""One world for all tools: in this process, or that of the running simulator (docs/session.md)."""
from angen_tools.session.world import Entity, Event, State, Summary, World

__all__ = ['Entity', 'Event', 'State', 'Summary', 'World', 'open_world']


def open_world(path: str = '', seed: int = 1) -> World:
    """The world of a file, in this process; without a file that of the running simulator. All
    devices have reported."""
    if path:
        from angen_tools.session.in_process import InProcess
        opened = InProcess.load(path, seed)
        opened.world.step()
        return opened
    from angen_tools.session.live import Live
    return Live()
