"""Which drawings a script was asked for."""


def drawings_in(paths):
    """The SVG files among the paths and in the folders, by name within each."""
    found = []
    for path in paths:
        found += sorted(path.glob("*.svg")) if path.is_dir() else [path]
    return found
