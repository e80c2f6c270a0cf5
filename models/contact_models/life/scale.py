"""Independent runs: one after the other in this process, or on several processes or a cluster by `dask.distributed`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from types import TracebackType
from typing import Any, Self, TypeVar

from contact.errors import ContactError, require_number

Item = TypeVar("Item")
Answer = TypeVar("Answer")

_PATIENCE = 20.0  # for the first worker [s]
_DEATHS = 5  # a task is given up after this number of workers have died with it


class Workers:
    """Workers for independent runs, as a context manager.

    A task is a pure function of its item. The results therefore do not depend on the number of workers or their order. If a
    worker dies, another worker repeats its task.

    Parameters
    ----------
    count : int
        Number of processes of this machine, 1 to 512. With 1 the tasks run in this process, without dask.
    scheduler : str, optional
        Address of a `dask.distributed` scheduler, like ``tcp://host:8786``, whose workers are used instead. They need this
        package.

    Raises
    ------
    ContactError
        If the number is outside its range, or on entry if the scheduler does not answer or has no workers.
    ImportError
        If dask is needed and the extra `scale` is not installed.
    """

    def __init__(self, count: int = 1, scheduler: str | None = None) -> None:
        self._count, self._scheduler = int(require_number("workers", count, 1, 512)), scheduler
        self._stack = ExitStack()
        self._client: Any = None

    def __enter__(self) -> Self:
        if self._scheduler is None and self._count == 1:
            return self
        try:
            import dask
            from dask.distributed import Client, LocalCluster
        except ImportError as missing:
            raise ImportError("several workers need dask: pip install 'wheelrail-contact[scale]'") from missing
        self._stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": _DEATHS}))
        address: Any = self._scheduler
        if address is None:
            address = self._stack.enter_context(
                LocalCluster(n_workers=self._count, threads_per_worker=1, dashboard_address=":0")
            )
        try:
            self._client = self._stack.enter_context(Client(address, timeout="20s"))
        except OSError as error:
            raise ContactError(f"scheduler = {self._scheduler!r} does not answer: {error}") from None
        try:
            self._client.wait_for_workers(1, timeout=_PATIENCE)
        except TimeoutError:
            self._stack.close()
            raise ContactError(
                f"scheduler = {address!r} has no workers after {_PATIENCE:g} s; start some with: dask worker {address}"
            ) from None
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._client = None
        self._stack.close()

    def map(
        self,
        function: Callable[[Item], Answer],
        items: Sequence[Item],
        watch: Callable[[int, int], None] = lambda done, total: None,
    ) -> list[Answer]:
        """Return the results in the order of the items. `watch` is called with the number done and the total number."""
        if self._client is None:
            answers = []
            for k, item in enumerate(items):
                answers.append(function(item))
                watch(k + 1, len(items))
            return answers
        from dask.distributed import as_completed

        futures = self._client.map(function, items, pure=False)
        for k, _ in enumerate(as_completed(futures)):
            watch(k + 1, len(items))
        return self._client.gather(futures)
