"""Crowds that several tests let walk."""

FOUR = [(3, 18, 1.0), (97, 30, 0.8), (66, 97, 0.6), (10, 90, 0.4)]
RATES = [1, 0.5, 0.8, 0.5, 0.7, 0.4, 0.6, 0.4]
EIGHT = [
    (*at, rate)
    for at, rate in zip([(3, 18), (40, 3), (97, 30), (97, 72), (66, 97), (35, 97), (10, 90), (3, 55)], RATES)
]


def park(gates=FOUR, **more):
    """A meadow of a hectare."""
    places = [{"name": f"gate {n}", "at": [x, y], "rate": rate} for n, (x, y, rate) in enumerate(gates)]
    return {"places": places, "seed": 1, **more}


def small(**more):
    """A meadow of 20 x 16 m between three places, walked in a second."""
    gates = [(2, 3, 1.0), (18, 5, 1.0), (9, 14, 0.5)]
    return park(gates, size=[20, 16], passages=240, renewals=24, **more)


def pressed(**more):
    """Some walkers, half of them from left to right through a rectangle, half to and fro."""
    places = [{"name": "left", "at": [1, 4]}, {"name": "right", "at": [15, 4]}]
    press = {"box": [6, 2.4, 8, 5.6], "cell": 0.04, **more}
    return {"places": places, "size": [16, 8], "passages": 12, "renewals": 3, "seed": 3, "press": press}


class Stopped(Exception):
    pass


def stop_after(count):
    told = []

    def progress(share):
        told.append(share)
        if len(told) == count:
            raise Stopped

    return progress
