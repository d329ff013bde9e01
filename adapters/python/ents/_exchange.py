# SPDX-License-Identifier: BSD-3-Clause
"""Messages between the processes of a communicator: between neighbours that know each other, between those that do not yet, and errors for all."""
from __future__ import annotations

import time
from typing import Any, Optional, Sequence

import numpy as np

from ._arrays import CutStep, Error
from ._structs import Status

TAGS = 1 << 14  # the MPI standard has at least this many
LONGEST_MESSAGE = 2000  # characters of an error that go to the other processes


class Exchange:
    """Point-to-point messages of float64 arrays. Collectives are used for a fixed number of values per process alone: their size does not
    grow with the mesh.

    messages, bytes   that this process has sent to others
    """

    def __init__(self, comm: Any) -> None:
        self.comm = comm.Dup()
        self.rank, self.size = self.comm.Get_rank(), self.comm.Get_size()
        self._tag, self.messages, self.bytes = 0, 0, 0

    def _next_tag(self) -> int:
        """Processes may be one exchange apart: two exchanges in a row must not take each other's messages."""
        self._tag = (self._tag + 1) % TAGS
        return self._tag

    def _count(self, arrays: Sequence[np.ndarray]) -> None:
        self.messages += len(arrays)
        self.bytes += sum(array.nbytes for array in arrays)

    def discover(self, sends: dict[int, np.ndarray]) -> dict[int, np.ndarray]:
        """{process: array} for processes that do not know that they will get one. Returns what has come here. (T. Hoefler, C. Siebert, A. Lumsdaine,
        Scalable communication protocols for dynamic sparse data exchange, PPoPP 2010: no array of the size of the communicator.)"""
        from mpi4py import MPI
        tag, status, received = self._next_tag(), MPI.Status(), {}
        others = {to: np.ascontiguousarray(array, np.float64).ravel() for to, array in sends.items() if to != self.rank}
        self._count(list(others.values()))
        requests = [self.comm.Issend(array, dest=to, tag=tag) for to, array in others.items()]
        barrier = None
        while barrier is None or not barrier.Test():
            message = self.comm.Improbe(source=MPI.ANY_SOURCE, tag=tag, status=status)
            if message is not None:
                array = np.empty(status.Get_count(MPI.DOUBLE))
                message.Recv(array)
                received[status.Get_source()] = array
            elif barrier is None and MPI.Request.Testall(requests):
                barrier = self.comm.Ibarrier()
            else:
                time.sleep(0)  # another process may need this core
        if self.rank in sends:
            received[self.rank] = np.ascontiguousarray(sends[self.rank], np.float64).ravel()
        return received

    def swap(self, sends: dict[int, np.ndarray], sources: Sequence[int]) -> dict[int, np.ndarray]:
        """{process: array} to processes that know that they will get one; one array comes from each of `sources`, of any length."""
        from mpi4py import MPI
        tag, status, received = self._next_tag(), MPI.Status(), {}
        others = {to: np.ascontiguousarray(array, np.float64).ravel() for to, array in sends.items() if to != self.rank}
        self._count(list(others.values()))
        requests = [self.comm.Isend(array, dest=to, tag=tag) for to, array in others.items()]
        for source in sources:
            if source == self.rank:
                received[source] = np.ascontiguousarray(sends[source], np.float64).ravel()
                continue
            message = self.comm.Mprobe(source=source, tag=tag, status=status)
            received[source] = np.empty(status.Get_count(MPI.DOUBLE))
            message.Recv(received[source])
        MPI.Request.Waitall(requests)
        return received

    def gather(self, values: np.ndarray) -> np.ndarray:
        """[size][values]: a few values of each process, for all processes."""
        mine = np.ascontiguousarray(values, np.float64)
        every = np.empty((self.size, len(mine)))
        self.comm.Allgather(mine, every)
        return every

    def largest(self, values: Sequence[float]) -> np.ndarray:
        """The largest of each value among the processes. Their number is that of the code, not of the mesh."""
        from mpi4py import MPI
        mine = np.array(values, np.float64)
        most = np.empty_like(mine)
        self.comm.Allreduce(mine, most, op=MPI.MAX)
        return most

    def agree(self, failure: Optional[BaseException], values: Sequence[float] = ()) -> np.ndarray:
        """All processes raise if one has failed, with the message of that one; a mistake goes before a step that is cut. Otherwise the largest of
        each value."""
        severity = 0 if failure is None else 1 if isinstance(failure, CutStep) else 2
        factor = failure.step_factor if isinstance(failure, CutStep) else 1.0
        most = self.largest([severity, -factor, -self.rank if severity == 1 else -self.size, -self.rank if severity == 2 else -self.size, *values])
        if most[0] == 0:
            return most[4:]
        who = int(-most[1 + int(most[0])])
        told = None
        if who == self.rank:
            known = isinstance(failure, Error)
            text = str(failure) if known else f"{type(failure).__name__}: {failure}"
            told = int(failure.status) if known else int(Status.INTERNAL), text[:LONGEST_MESSAGE], failure.element if known else -1
        status, text, element = self.comm.bcast(told, root=who)
        if who == self.rank and severity == 2:
            raise failure
        text = f"process {who} of {self.size}: {text}" if self.size > 1 else text
        if most[0] == 1:
            raise CutStep(Status(status), text, element, float(-most[1])) from (failure if who == self.rank else None)
        raise Error(Status(status), text, element)


class Guard:
    """Keeps the error of a block of code, so that this process takes part in the exchanges that follow; `Exchange.agree` raises it.

        with guard:
            ...
    """

    def __init__(self) -> None:
        self.failure: Optional[Exception] = None

    def __enter__(self) -> Guard:
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> bool:
        if not isinstance(value, Exception):
            return False
        self.failure = self.failure or value
        return True
