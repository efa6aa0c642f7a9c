"""Structural dynamics: component modes of the segments, hinges, and the joined wing."""
