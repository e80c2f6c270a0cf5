"""Independent runs, here or on a cluster: `dask.distributed` where it is asked for, one after the other otherwise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from types import TracebackType
from typing import Any, Self, TypeVar

from contact.errors import ContactError, require_number

Item = TypeVar("Item")
Answer = TypeVar("Answer")

_DEATHS = 5  # of workers over one task, after which it is held to be the killer


class Workers:
    """Where runs are done; a context manager.

    A task is a pure function of its item, so that the answers do not depend on how many workers there are, on their order or on
    their deaths: what a dead worker had in hand is done again by another one.

    Parameters
    ----------
    count : int
        Processes of this machine, 1 to 512; 1 stays in this process and needs no dask.
    scheduler : str, optional
        Address of a `dask.distributed` scheduler, as ``tcp://host:8786``, whose workers are taken instead. They need this
        package.

    Raises
    ------
    ContactError
        A number outside its range.
    ImportError
        Without the extra `scale`, when dask is asked for.
    """

    def __init__(self, count: int = 1, scheduler: str | None = None) -> None:
        self._count, self._scheduler = int(require_number("workers", count, 1, 512)), scheduler
        self._stack, self._client = ExitStack(), None

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
        """Answers in the order of the items; `watch` is told how many are done, and of how many."""
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
