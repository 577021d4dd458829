"""A hand at the page of angen edit: each press, drag and key counts as a gesture."""
from browser import Page
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.interaction import POINTER_MOUSE
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.keys import Keys

Place = tuple[float, float]
ROOMS = (('kitchen', (1.0, 2.2)), ('bedroom', (4.6, 2.4)), ('livingroom', (6.5, 4.5)))


class Hand:
    """Draws by real events of a pointer or the keyboard, at places in m."""

    def __init__(self, page: Page, kind: str = POINTER_MOUSE) -> None:
        self.page, self.kind = page, kind
        self.gestures = 0

    def drag(self, *places: Place) -> None:
        """Presses at the first place, and releases at the last one."""
        self.gestures += 1
        pixels = self.page.run('return arguments[0].map((at) => angen.board.screen(at))', places)
        pointer = PointerInput(self.kind, self.kind)
        builder = ActionBuilder(self.page.driver, mouse=pointer, duration=0)
        for i, (x, y) in enumerate(pixels):
            pointer.create_pointer_move(0, round(x), round(y))
            if i == 0:
                pointer.create_pointer_down(button=0)
        pointer.create_pointer_up(0)
        builder.perform()

    press = drag

    def button(self, selector: str) -> None:
        """Presses a button of the page."""
        self.gestures += 1
        self.page.press(selector)

    def keys(self, *keys: str) -> None:
        """Types keys one after the other."""
        self.gestures += len(keys)
        ActionChains(self.page.driver, duration=0).send_keys(*keys).perform()

    def control(self, *keys: str) -> None:
        """Types keys while Ctrl is held."""
        self.gestures += len(keys)
        chain = ActionChains(self.page.driver, duration=0).key_down(Keys.CONTROL)
        chain.send_keys(*keys).key_up(Keys.CONTROL).perform()

    def put(self, name: str, *places: Place) -> None:
        """Takes something from the catalog, and presses or drags on the drawing."""
        self.button(f'[data-name="{name}"]')
        self.drag(*places)


def draw_flat(hand: Hand) -> None:
    """The apartment of the tutorial: three rooms, a doorway, a door, sensors, robot and person."""
    hand.button('#tool-room')
    hand.drag((0, 0), (8, 6))
    hand.button('#tool-wall')
    hand.drag((0, 3), (8, 3))
    hand.press((4, 0))
    hand.press((4, 3))
    hand.put('passage', (2, 3))
    hand.put('door', (6, 2.96))
    hand.put('door', (8, 4.5))
    hand.put('window', (2, 0.04))
    hand.put('window', (6, 0.04))
    hand.put('window', (4, 5.96))
    hand.put('stove', (3.6, 0.4))
    hand.put('sink', (2.9, 0.4))
    hand.put('fridge', (0.4, 2.5))
    hand.put('bed', (6.9, 1.2))
    hand.put('wardrobe', (4.4, 0.7))
    hand.put('sofa', (1.5, 5.6))
    hand.put('table', (4.3, 5.5))
    hand.put('chair', (4.3, 4.8))
    hand.put('tv', (1.5, 3.3))
    for lamp in ((2, 1.5), (6, 2), (4, 4.5)):
        hand.put('lamp', lamp)
    hand.put('motion sensor', (0.15, 0.15))
    hand.put('motion sensor', (7.85, 5.85), (4, 4))
    hand.put('motion sensor', (4.15, 0.2))
    hand.put('light sensor', (0.15, 1.5))
    hand.put('temperature sensor', (3, 5.9))
    hand.put('camera', (0.15, 5.85))
    hand.put('person', (2, 2.2))
    hand.put('person', (5, 4.2))
    hand.put('robot', (2.6, 4.2))
    hand.page.until('return angen.rooms.length === 3 && !angen.asking && !angen.stale')
    for name, place in ROOMS:
        hand.press(place)
        hand.button('#card input')
        hand.page.run('document.querySelector("#card input").select()')
        hand.keys(name, Keys.ENTER)
