"""How hosts spell the URI of the resources."""

import re

SPELLINGS = {
    "capital letters": lambda uri: uri.replace("file:", "FILE:"),
    "mixed letters": lambda uri: uri.replace("file:", "File:"),
    "one slash": lambda uri: uri.replace("file:///", "file:/"),
    "localhost": lambda uri: uri.replace("file:///", "file://localhost/"),
    "a query": lambda uri: uri + "?version=2",
    "a fragment": lambda uri: uri + "#top",
    "both": lambda uri: uri + "?version=2#top?",
    "a last slash": lambda uri: uri + "/",
    "small hexadecimal digits": lambda uri: re.sub("%[0-9A-F]{2}", lambda found: found[0].lower(), uri),
    "letters that need no code": lambda uri: uri.replace("resources", "%72esource%73"),
}
OF_WINDOWS = {
    "a colon as code": lambda uri: uri.replace("Z:", "Z%3A"),
    "a colon as code in small letters": lambda uri: uri.replace("Z:", "z%3a"),
    "a small drive": lambda uri: uri.replace("Z:", "z:"),
}
