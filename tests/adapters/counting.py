"""counting.py: a communicator of mpi4py that counts the bytes of its calls."""
import pickle


class Counting:
    """.collective, .calls: bytes that this process gives to and takes from collectives, and their number; .sent: bytes of messages to other processes."""

    def __init__(self, comm, counts=None):
        self._comm, self.counts = comm, {"collective": 0, "calls": 0, "sent": 0} if counts is None else counts

    collective, calls, sent = (property(lambda self, name=name: self.counts[name]) for name in ("collective", "calls", "sent"))

    def Dup(self):
        return Counting(self._comm.Dup(), self.counts)

    def __getattr__(self, name):
        method = getattr(self._comm, name)
        if name in ("Allreduce", "Allgather"):
            return lambda give, take, *rest, **more: self._collective(give.nbytes + take.nbytes, lambda: method(give, take, *rest, **more))
        if name in ("bcast", "allreduce", "allgather"):
            def small(value=None, *rest, **more):
                result = method(value, *rest, **more)
                return self._collective(len(pickle.dumps(value)) + len(pickle.dumps(result)), lambda: result)
            return small
        if name in ("Isend", "Issend"):
            def send(array, *rest, **more):
                self.counts["sent"] += array.nbytes
                return method(array, *rest, **more)
            return send
        if name in ("Get_rank", "Get_size", "rank", "size", "Ibarrier", "Improbe", "Mprobe", "py2f"):
            return method
        raise AttributeError(f"{name}: a call that is not counted")

    def _collective(self, size, call):
        self.counts["collective"] += size
        self.counts["calls"] += 1
        return call()
