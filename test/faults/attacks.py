"""Attacks, and the list to which each module of attacks adds."""

import collections
import re

Attack = collections.namedtuple(
    "Attack", "name group act deadline growth_mb silence dies storms fast")
groups = collections.OrderedDict()  # name -> Group


class Failed(Exception):
    """An expectation of an attack is not met."""


class Group:
    """Attacks that share a node: `setting` holds arguments of node_under_test.Node; None: no node is started."""

    def __init__(self, name, setting=None):
        self.name = name
        self.setting = setting
        self.attacks = []
        groups[name] = self

    def add(self, name, act, deadline=30.0, growth_mb=200.0, silence=10.0, dies=False, storms=True, fast=False):
        """`act(arena)` attacks and raises Failed. deadline: longest duration, s; growth_mb: largest growth of
        the node; silence: longest time without an answer to list_bodies, s; dies: the attack itself ends the
        node; storms: takes part in storms; fast: belongs to the subset of every test run."""
        if any(attack.name == name for attack in self.attacks):
            raise ValueError("two attacks of group '%s' are called '%s'" % (self.name, name))
        self.attacks.append(Attack(name, self.name, act, deadline, growth_mb, silence, dies, storms, fast))

    def attack(self, **options):
        """The same as a decorator: the attack has the function's name."""
        def register(function):
            self.add(function.__name__, function, **options)
            return function
        return register


def expect(condition, text):
    if not condition:
        raise Failed(text)


def shortened(text, length=160):
    """The text on one line, cut to a length."""
    line = re.sub(r"[^ -~]+", " ", str(text)).strip()
    return line if len(line) <= length else line[:length - 3] + "..."
