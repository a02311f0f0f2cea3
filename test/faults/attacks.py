"""What an attack is, and the list that each module of attacks adds to."""

import collections
import re

Attack = collections.namedtuple(
    "Attack", "name group act deadline growth_mb silence dies storms fast")
groups = collections.OrderedDict()  # name -> Group


class Failed(Exception):
    """An expectation of an attack does not hold."""


class Group:
    """Attacks that share a node: `setting` is what node_under_test.Node takes; None: no node is started.
    beside: they need no master either and run beside the other groups."""

    def __init__(self, name, setting=None, beside=False):
        self.name = name
        self.setting = setting
        self.beside = beside
        self.attacks = []
        groups[name] = self

    def add(self, name, act, deadline=30.0, growth_mb=200.0, silence=10.0, dies=False, storms=True, fast=False):
        """`act(arena)` attacks and raises Failed. deadline: s that it may take; growth_mb: by which the node may
        grow meanwhile; silence: s that the node may leave list_bodies unanswered; dies: the attack ends the node by
        itself; storms: takes part in storms; fast: belongs to the subset of every test run."""
        if any(attack.name == name for attack in self.attacks):
            raise ValueError("two attacks of group '%s' are called '%s'" % (self.name, name))
        self.attacks.append(Attack(name, self.name, act, deadline, growth_mb, silence, dies, storms, fast))

    def attack(self, **options):
        """The same as a decorator: the function's name is the attack's."""
        def register(function):
            self.add(function.__name__, function, **options)
            return function
        return register


def expect(condition, text):
    if not condition:
        raise Failed(text)


def shortened(text, length=160):
    """A text as a part of one line."""
    line = re.sub(r"[^ -~]+", " ", str(text)).strip()
    return line if len(line) <= length else line[:length - 3] + "..."
