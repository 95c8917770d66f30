"""Writes film_stacks.csv: reflectance of 1000 random stacks of films by the package `tmm` of PyPI.

    pip install tmm==0.2.0 && python3 film_stacks.py > film_stacks.csv

A line is a stack: cos θ in the medium outside, n of that medium, n and k of the base, R_s, R_p, and of each layer, outermost first,
n, k and thickness over the wavelength in a vacuum. Nearer to grazing than cos θ = .01, `tmm` itself loses digits: 2e-12 at .0006,
by 60 digits.
"""

import contextlib
import math
import random
import sys

import tmm

random.seed(20)
print("cos_theta,outside,n,k,s,p,layers")
for _ in range(1000):

    def medium():
        clear = random.random() < 0.5
        n = round(random.uniform(1.0, 3.0) if clear else random.uniform(0.05, 5.0), 3)
        return n, 0.0 if clear else round(random.choice([1e-3, 0.1, 1.0, 6.0]) * random.random(), 5)

    outside = random.choice([1.0, 1.0, 1.33, 1.5])
    cos_theta = round(random.uniform(0.01, 1.0), 4)
    layers = [
        (*medium(), round(random.choice([0.01, 0.3, 3.0]) * random.random(), 5))
        for _ in range(random.randint(1, 6))
    ]
    base = medium()
    media = [outside, *(complex(n, k) for n, k, _ in layers), complex(*base)]
    thick = [math.inf, *(waves for *_, waves in layers), math.inf]
    # The angle is what `tmm` takes; its cosine differs from the one it was made of.
    angle = math.acos(cos_theta)
    cos_theta = math.cos(angle)
    with contextlib.redirect_stdout(sys.stderr):
        s, p = (float(tmm.coh_tmm(light, media, thick, angle, 1.0)["R"]) for light in "sp")
    told = " ".join(f"{n:g} {k:g} {waves:g}" for n, k, waves in layers)
    print(f"{cos_theta!r},{outside:g},{base[0]:g},{base[1]:g},{s!r},{p!r},{told}")
