# SPDX-License-Identifier: BSD-3-Clause
"""What a process knows of surfaces that are distributed: its own facets, facets of others (ghosts), and the nodes of all of these."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ._arrays import Error
from ._exchange import Exchange, Guard
from ._structs import Status


class Facets(NamedTuple):
    """Facets with nodes that are named by their numbers among all processes, which mean the same everywhere."""
    ids: np.ndarray
    """[n] number of each facet among all processes"""
    nodes: np.ndarray
    """[n][k] numbers of their nodes"""
    owners: np.ndarray
    """[n][k] the process that owns each node"""
    values: np.ndarray
    """[n][c] further numbers: surface coordinates"""

    def take(self, which: Any) -> Facets:
        return Facets(*(array[which] for array in self))

    def packed(self) -> np.ndarray:
        """One array for a message; whole numbers below 2^53 are exact in it."""
        return np.column_stack([self.ids, self.nodes, self.owners, self.values]).astype(np.float64, copy=False)

    def unpacked(self, array: np.ndarray) -> Facets:
        """The facets of a message, which are like these."""
        k = self.nodes.shape[1]
        rows = array.reshape(-1, 1 + 2 * k + self.values.shape[1])
        return Facets(rows[:, 0].astype(np.int64), rows[:, 1:1 + k].astype(np.int64), rows[:, 1 + k:1 + 2 * k].astype(np.int64), rows[:, 1 + 2 * k:])

    def joined(self, others: list[Facets]) -> Facets:
        """These and others, each facet once, in an order of their nodes' numbers: it does not depend on the number of processes."""
        every = Facets(*(np.concatenate(arrays) for arrays in zip(self, *others)))
        every = every.take(np.unique(every.ids, return_index=True)[1])
        return every.take(np.lexsort(every.nodes.T[::-1]))

    def touching(self, which: np.ndarray, layers: int) -> np.ndarray:
        """[n] bool: the facets `which` [n] bool, and `layers` of facets around them that share a node."""
        for _ in range(layers):
            which = np.isin(self.nodes, self.nodes[which]).any(axis=1)
        return which


def to_owners(exchange: Exchange, facets: Facets) -> Facets:
    """The facets of all processes that have a node of this one, each process giving its own."""
    sends = {int(owner): facets.take((facets.owners == owner).any(axis=1)).packed() for owner in np.unique(facets.owners)}
    received = exchange.discover(sends)
    return facets.take(slice(0, 0)).joined([facets.unpacked(array) for array in received.values()])


def widened(exchange: Exchange, facets: Facets, stars: Facets) -> Facets:
    """`facets` and a layer of facets around them. stars: those that have a node of this process (to_owners)."""
    nodes, first = np.unique(facets.nodes, return_index=True)
    owners = facets.owners.ravel()[first]
    asked = exchange.discover({int(owner): nodes[owners == owner] for owner in np.unique(owners)})
    answers = {source: stars.take(np.isin(stars.nodes, numbers.astype(np.int64)).any(axis=1)).packed() for source, numbers in asked.items()}
    received = exchange.swap(answers, np.unique(owners).tolist())
    return facets.joined([facets.unpacked(array) for array in received.values()])


class Given(NamedTuple):
    """The nodes that a program gives on a process: its own, and nodes of others that its facets name."""
    positions: np.ndarray
    """[n][d] undeformed"""
    dofs: np.ndarray
    """[n][d] equations among all processes"""
    numbers: np.ndarray
    """[n] among all processes"""
    owners: np.ndarray
    """[n]"""
    place: np.ndarray
    """[own] places of the own nodes here, in an order of ascending numbers"""

    def find(self, numbers: np.ndarray) -> np.ndarray:
        """Places of own nodes."""
        own = self.numbers[self.place]
        at = np.searchsorted(own, numbers)
        wrong = np.flatnonzero(own[np.minimum(at, len(own) - 1)] != numbers) if len(own) else np.arange(len(numbers))
        if len(wrong):
            raise Error(Status.BAD_VALUE, f"numbers: another process names node {int(numbers[wrong[0]])} as one of this process, which does not give it "
                        f"({len(wrong)} such nodes): give every node of the surfaces that this process owns, and the same numbers and owners everywhere")
        return self.place[at]


class Halo:
    """Nodes that a process needs, own and others', and what their owners know of them. Owners remember who needs which: new displacements then go
    from each owner to each of these in one message.

    numbers [n] ascending; positions [n][d] undeformed; dofs [n][d]; begin, u [n][d] displacements at the begin of the increment, and now
    """

    def __init__(self, exchange: Exchange, guard: Guard, given: Given, numbers: np.ndarray, owners: np.ndarray, begin: np.ndarray, u: np.ndarray) -> None:
        d = given.positions.shape[1]
        self._exchange = exchange
        self.numbers, first = np.unique(numbers, return_index=True)
        owners = owners[first]
        self._wanted = {int(owner): np.flatnonzero(owners == owner) for owner in np.unique(owners)}
        asked = exchange.discover({owner: self.numbers[place] for owner, place in self._wanted.items()})
        self._needed: dict[int, np.ndarray] = {}
        answers = {}
        for source, asked_numbers in asked.items():
            self._needed[source] = np.zeros(len(asked_numbers), np.int64)
            answers[source] = np.zeros((len(asked_numbers), 4 * d))
            with guard:
                at = self._needed[source] = given.find(asked_numbers.astype(np.int64))
                answers[source] = np.hstack([given.positions[at], given.dofs[at], begin[at], u[at]])
        table = np.zeros((len(self.numbers), 4 * d))
        for owner, array in exchange.swap(answers, list(self._wanted)).items():
            table[self._wanted[owner]] = array.reshape(-1, 4 * d)
        self.positions, dofs, self.begin, self.u = (np.ascontiguousarray(part) for part in np.split(table, 4, axis=1))
        self.dofs = dofs.astype(np.int64)
        self.ghosts = sum(len(place) for owner, place in self._wanted.items() if owner != exchange.rank)

    def update(self, u: np.ndarray) -> None:
        """New displacements [given nodes][d]."""
        received = self._exchange.swap({to: u[place] for to, place in self._needed.items()}, list(self._wanted))
        for owner, array in received.items():
            self.u[self._wanted[owner]] = array.reshape(-1, self.u.shape[1])

    def needed(self) -> np.ndarray:
        """Places among the given nodes whose displacements processes need."""
        return np.unique(np.concatenate([np.zeros(0, np.int64), *self._needed.values()]))

    def find(self, numbers: np.ndarray) -> np.ndarray:
        """Places of nodes that are here."""
        return np.searchsorted(self.numbers, numbers)
