"""Offsets of surfaces in the range of item IDs."""


def offsets(sizes):
    """One offset per surface; sizes holds the number of texels of each surface."""
    found, next_free = [], 0
    for size in sizes:
        found.append(next_free)
        next_free += size
    return found
