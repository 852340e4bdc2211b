"""Makes `import lariat` mean `lariat_cables` where no other module is called `lariat`.

The Python package index has another distribution with a module of that name, so the files of this one are called
`lariat_cables`. `lariat_cables.pth` imports this module when Python starts; it imports nothing else until `lariat` is asked for.
"""

import sys

OURS, ALIAS = "lariat_cables", "lariat"


class _Loader:
    """Hands out a module that exists under its own name."""

    def create_module(self, spec):
        from importlib import import_module

        module = import_module(OURS + spec.name[len(ALIAS) :])
        self.spec = module.__spec__
        return module

    def exec_module(self, module):
        # the import set that of the alias
        module.__spec__ = self.spec


class _Finder:
    """Finds `lariat`, and the modules below it, if it is ours."""

    @staticmethod
    def find_spec(name, path=None, target=None):
        if name != ALIAS and not name.startswith(ALIAS + "."):
            return None
        from importlib.machinery import ModuleSpec

        if name == ALIAS:
            others = (finder for finder in sys.meta_path if finder is not _Finder)
            if any(finder.find_spec(name, path, target) is not None for finder in others):
                return None
        elif sys.modules.get(ALIAS) is not sys.modules.get(OURS, sys):
            return None
        return ModuleSpec(name, _Loader(), is_package=name == ALIAS)


# before the finder of files, which would load the modules of the package a second time
sys.meta_path.insert(0, _Finder)
