"""Names of rooms and models from the texts of a plan, and the uses of rooms."""
import re
import unicodedata

LONGEST = 40
LETTERS = 'abcdefghijklmnopqrstuvwxyz'
# the first that is in the name, in lower case without accents
USES = (
    ('bedroom', ('bedr', 'bed room', 'guest', 'nursery', 'chambre', 'schlaf', 'kinderz', 'sov',
                 'dormitor', 'camera da letto', 'спальн', 'детск', '卧', '寝室')),
    ('bathroom', ('bath', 'toilet', 'wc', 'shower', 'restroom', 'salle de bain', 'bad',
                  'lavatory', 'bano', 'bagno', 'ванн', 'туалет', 'санузел', '卫生间', '浴', '厕',
                  '洗手间')),
    ('kitchen', ('kitchen', 'cuisine', 'kuche', 'kueche', 'kok', 'pantry', 'cocina', 'cucina',
                 'cozinha', 'кухн', '厨', '台所')),
    ('living', ('living', 'lounge', 'dining', 'salon', 'sejour', 'wohn', 'family', 'vardagsrum',
                'soggiorno', 'гостин', '客厅', '餐厅', '起居', '居間')),
    ('work', ('office', 'work', 'study', 'bureau', 'arbeit', 'meeting', 'desk', 'despacho',
              'кабинет', '书房', '办公', '書斎')),
    ('outdoor', ('balc', 'terrac', 'terraz', 'garden', 'patio', 'outdoor', 'jardin', 'garten',
                 'roof', 'porch', 'балкон', 'террас', '阳台', '露台', '花园', '庭')),
    ('landing', ('landing', 'stair', 'lobby', 'elevator', 'lift', 'лестниц', '楼梯', '电梯')),
    ('hall', ('hall', 'corridor', 'entr', 'flur', 'couloir', 'foyer', 'passage', 'vestib',
              'pasillo', 'corridoio', 'коридор', 'прихож', '走廊', '过道', '玄关', '门厅', '廊下')),
)
# the use of a room without a name, by its contents; the first that it has
BY_THINGS = (
    ('bathroom', ('toilet', 'shower', 'bathtub')),
    ('kitchen', ('stove', 'fridge')),
    ('bedroom', ('bed',)),
    ('living', ('sofa', 'tv')),
    ('work', ('desk',)),
    ('living', ('armchair', 'table')),
)


def slug(text: str, otherwise: str = 'room') -> str:
    """A name of lower-case letters, digits and _, which begins with a letter."""
    plain = unicodedata.normalize('NFKD', text.replace('ß', 'ss')).encode('ascii', 'ignore')
    words = re.findall(r'[a-z0-9]+', plain.decode().lower())
    made = '_'.join(words)[:LONGEST].strip('_')
    if not made or not made[0].isalpha():
        made = f'{otherwise}_{made}'.rstrip('_')
    return made


def plain_name(text: str, otherwise: str) -> str:
    """A name without the characters that a model's name may not contain."""
    return re.sub(r'[^A-Za-z0-9_. -]', '_', text).strip()[:LONGEST] or otherwise


def line_of(text: str) -> str:
    """A text for people as one line without control characters."""
    return ' '.join(''.join(each if each.isprintable() else ' ' for each in text).split())[:LONGEST]


def use_of(name: str) -> str:
    """The use of a room by its name; '' if the name does not tell it."""
    plain = ''.join(each for each in unicodedata.normalize('NFKD', name.lower())
                    if not unicodedata.combining(each))
    for use, words in USES:
        if any(word in plain for word in words):
            return use
    return ''


def use_by_things(things: set[str]) -> str:
    """The use of a room by its things."""
    for use, typical in BY_THINGS:
        if things & set(typical):
            return use
    return 'other'


class Names:
    """Allocates unique names: NAME, or with a letter NAME_b, and the storey's number last."""

    def __init__(self) -> None:
        self._taken: set[str] = set()
        self._tried: dict[tuple[str, int | None], int] = {}

    def take(self, stem: str, number: int | None = None) -> str:
        """A free name like the stem."""
        tried = self._tried.get((stem, number), 0)
        while (name := with_number(stem + self._ending(tried), number)) in self._taken:
            tried += 1
        self._tried[stem, number] = tried + 1
        self._taken.add(name)
        return name

    @staticmethod
    def _ending(tried: int) -> str:
        if tried == 0:
            return ''
        return f'_{LETTERS[tried]}' if tried < len(LETTERS) else f'_z{tried - len(LETTERS)}'


def apart(name: str) -> tuple[str, str]:
    """A name without the number at its end, and that number."""
    stem = name.rstrip('0123456789')
    return stem.rstrip('_'), name[len(stem):]


def stem(name: str) -> str:
    """A name without the storey's number."""
    return apart(name)[0]


def with_number(stem: str, number: int | None) -> str:
    """The stem and a storey's number, apart from a digit before it."""
    if number is None:
        return stem
    gap = '_' if stem[-1:].isdigit() else ''
    return f'{stem}{gap}{number}' if number >= 0 else f'{stem}_m{-number}'
