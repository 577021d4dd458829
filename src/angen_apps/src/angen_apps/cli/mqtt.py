"""angen mqtt on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.arguments import checked
from angen_tools.cli.parser import command

PORT = 1883


def run_mqtt(args: argparse.Namespace) -> int:
    from angen_apps.mqtt.broker import Access
    from angen_apps.mqtt.command import read_password, serve
    if (args.password_file or args.user) and not (args.password_file and args.user):
        args.parser.error('--user and --password-file belong together')
    if bool(args.cert) != bool(args.key):
        args.parser.error('--cert and --key belong together')
    host, port = args.broker
    access = Access(host, port, args.user, read_password(args.password_file),
                    bool(args.tls or args.ca or args.cert), args.ca, args.cert, args.key)
    serve(access, args.prefix, args.style, args.discovery, args.profile, args.truth)
    return 0


def address(text: str) -> tuple[str, int]:
    """HOST:PORT; without a port that of MQTT."""
    host, colon, number = text.rpartition(':') if text.count(':') == 1 else (text, '', '')
    if text.startswith('['):  # IPv6
        host, _, number = text[1:].partition(']')
        number = number.removeprefix(':')
    if host and (not number and not colon or number.isascii() and number.isdigit()
                 and 1 <= int(number) <= 65535):
        return host, int(number or PORT)
    raise ValueError(f"'{text}' is not the address of a broker; give HOST or HOST:PORT")


def prefix(text: str) -> str:
    """The first levels of topics."""
    levels = text.split('/')
    if len(text) <= 100 and all(level and level.isprintable() and not set(level) & set('+#$')
                                for level in levels) and levels[0] != 'homeassistant':
        return text
    raise ValueError(f"'{text:.100}' cannot begin a topic; give a word, as angen or house1/angen")


def add_mqtt(commands: Any) -> None:
    """angen mqtt."""
    mqtt = command(commands, 'mqtt', run_mqtt,
                   'connects the running building to an MQTT broker, for Home Assistant, Node-RED '
                   'and other programs', 'mqtt', 'mqtt --broker 192.168.1.5:1883',
                   'mqtt --prefix zigbee2mqtt --style zigbee2mqtt', 'mqtt --profile shop')
    mqtt.set_defaults(parser=mqtt)
    mqtt.add_argument('--broker', metavar='HOST:PORT', type=checked(address),
                      default=('127.0.0.1', PORT), help=f'the broker (127.0.0.1:{PORT})')
    mqtt.add_argument('--prefix', metavar='TOPIC', type=checked(prefix), default='angen',
                      help='topics begin with it; each of several buildings has its own (angen)')
    mqtt.add_argument('--style', choices=('plain', 'zigbee2mqtt'), default='plain',
                      help='a topic for each value, or the topics of Zigbee2MQTT (plain)')
    mqtt.add_argument('--discovery', choices=('entity', 'device', 'none'), default='entity',
                      help='messages for Home Assistant: one an entity, or one a device, which it '
                      'reads from 2024.11 on (entity)')
    mqtt.add_argument('--profile', metavar='FILE', default='',
                      help="habits of hardware, a YAML file, or 'shop': reports as of sensors that "
                      'one buys')
    mqtt.add_argument('--truth', action='store_true',
                      help='also what no real home knows: the room of each person')
    mqtt.add_argument('--user', metavar='NAME', default='', help='the name at the broker')
    mqtt.add_argument('--password-file', metavar='FILE', type=Path,
                      help='a file whose first line is the password')
    mqtt.add_argument('--tls', action='store_true', help='encrypts the connection')
    mqtt.add_argument('--ca', metavar='FILE', type=Path,
                      help='the certificate that signs that of the broker; implies --tls')
    mqtt.add_argument('--cert', metavar='FILE', type=Path, help="this client's certificate")
    mqtt.add_argument('--key', metavar='FILE', type=Path, help='the key of that')
