"""Contract for import-linter: the modules of a package import only what is listed."""

from importlinter import Contract, ContractCheck, fields, output


class AllowedContract(Contract):
    """`source` may import itself and the packages in `allowed` with their submodules. Everything else is forbidden."""

    source = fields.StringField()
    allowed = fields.ListField(subfield=fields.StringField())

    def check(self, graph, verbose):
        def listed(module):
            return any(module == name or module.startswith(name + ".") for name in (self.source, *self.allowed))

        sources = {self.source, *graph.find_descendants(self.source)}
        wrong = sorted(
            (source, module)
            for source in sources
            for module in graph.find_modules_directly_imported_by(source)
            if not listed(module)
        )
        return ContractCheck(kept=not wrong, metadata={"wrong": wrong})

    def render_broken_contract(self, check):
        for source, module in check.metadata["wrong"]:
            output.print_error(f"{source} imports {module}, which is not in the list: {', '.join(self.allowed)}")
