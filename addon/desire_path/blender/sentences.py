"""sentences.py - what was put together in English is told in the language of the interface.

    sentence --which template made it?--> its values, each told likewise --> the same template in another language

What the add-on says, and what the rooms say that do not know Blender, is written out in English where it arises; where
it goes to a reader it is taken apart again. What no template made, and names of the user's, are told as they are.
"""

import functools
import re

import bpy

from . import (
    sentences_bake,
    sentences_blender,
    sentences_crowd,
    sentences_ground,
    sentences_phrases,
    sentences_rig,
    sentences_tools,
    sentences_tracks,
    sentences_walker,
)

LONGEST = 4000  # letters; what is longer is told as it is
_GERMAN = (
    sentences_blender,
    sentences_tools,
    sentences_bake,
    sentences_ground,
    sentences_walker,
    sentences_rig,
    sentences_tracks,
    sentences_crowd,
    sentences_phrases,
)
LANGUAGES = {"de_DE": _GERMAN, "de": _GERMAN}  # newer Blenders name a language without its country


def translated(text):
    """A sentence, or several, in the language in which Blender tells its own, by the user's preferences."""
    view = bpy.context.preferences.view
    if not getattr(view, "use_translate_reports", view.use_translate_tooltips):
        return text
    return said(bpy.app.translations.locale, text)


@functools.lru_cache(maxsize=512)
def said(language, text):
    """A text in a language, as "de_DE"; as it is where that is not known."""
    if language not in LANGUAGES or len(text) > LONGEST:
        return text
    return words(language).translated(text)


@functools.lru_cache(maxsize=2)
def words(language):
    """The Words of a language."""
    return Words({english: there for part in LANGUAGES[language] for english, there in part.GERMAN.items()})


class Words:
    """Templates of sentences and phrases, with {} for what comes in, and the same in another language."""

    def __init__(self, table):
        self.plain = {english: there for english, there in table.items() if "{}" not in english}
        self.open = sorted((Template(*each) for each in table.items() if "{}" in each[0]), key=lambda each: -each.says)

    def translated(self, text):
        """A text in the other language, as far as it is known."""
        return self._one(text) or self._listed(text) or self._several(text)

    def _one(self, text):
        """A text that one template made, of those that did the one that says most; None where none did."""
        if text in self.plain:
            return self.plain[text]
        return next(filter(None, (each.translated(text, self.translated) for each in self.open)), None)

    def _listed(self, text):
        """Known phrases, as "a, b and c"; None where one is not known."""
        parts = re.split(r"(, | and )", text)
        found = [self.plain.get(each) or self.plain.get(each[:1].lower() + each[1:]) for each in parts[::2]]
        if None in found:
            return None
        between = [each.replace(" and ", self.plain[" and "]) for each in parts[1::2]]
        return "".join(one + other for one, other in zip(found, [*between, ""]))

    def _several(self, text):
        """Sentences, or lines with semicolons between, one after the other, each as long as it can be."""
        ends = [found.end() for found in re.finditer(r"[.!?;](?= )", text)]
        out, start = [], 0
        while ends and start < len(text):
            after = [*(end for end in ends if end > start), len(text)]
            parts = (text[start:end] for end in reversed(after) if (start, end) != (0, len(text)))
            part, there = next(((part, there) for part in parts if (there := self._ended(part))), (None, None))
            part = part or text[start : after[0]]
            out.append(there or part)
            start += len(part) + 1
        return " ".join(out) if out else text

    def _ended(self, text):
        """One of several: what ends it may be of the list that it stands in."""
        there = self._one(text)
        if there is None and text.endswith((";", ".")):
            there = self._one(text[:-1])
            return there and there + text[-1]
        return there


class Template:
    """A sentence with {} for what comes in."""

    def __init__(self, english, there):
        self.pieces, self.there = english.split("{}"), there
        self.longest = max(self.pieces, key=len)
        self.says = sum(map(str.isalpha, english))

    def translated(self, text, value):
        """In the other language, its values as value() tells them; None where it did not make a text."""
        if self.longest not in text:
            return None
        found = _pattern(*self.pieces).fullmatch(text)
        if found is None:
            return None
        values = []
        for one, (before, after) in zip(found.groups(), zip(self.pieces, self.pieces[1:])):
            is_name = before.endswith("'") and after.startswith("'")
            if "' " in one or " '" in one if is_name else re.search(r"[.!?] (?=[A-Z'])", one):
                return None  # it is of several sentences
            values.append(one if is_name else value(one))
        return self.there.format(*values)


@functools.lru_cache(maxsize=1024)
def _pattern(*pieces):
    """What a template may have made; of two values side by side the first has no spaces."""
    escaped = list(map(re.escape, pieces))
    holes = [*("(.*?)" if each else r"(\S*)" for each in pieces[1:-1]), "(.*?)"]
    return re.compile("".join(one + hole for one, hole in zip(escaped, holes)) + escaped[-1], re.DOTALL)
