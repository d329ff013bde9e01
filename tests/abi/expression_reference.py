#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random expressions with their values and derivatives to 40 digits, for expression_reference_test.cpp.

usage: expression_reference.py COUNT SEED [SYMBOLIC]

A line is: text TAB u TAB v TAB ten numbers TAB ten error bounds, the latter two separated by blanks, in the order h, h_u, h_v, h_uu, h_uv,
h_vv, h_uuu, h_uuv, h_uvv, h_vvv. The numbers come from series in 40 digits (mpmath), which are multiplied out here and nowhere else; of the
first SYMBOLIC expressions they are compared with what SymPy's symbolic derivatives give. An error bound is what rounding to double
precision in every operation may make of the number, to first order.

exit status: 0 done; 1 series and symbolic derivatives differ; 77 a Python module is missing"""
import random
import sys

try:
    import mpmath
    import sympy
except ImportError as missing:
    print(f"{missing.name} is not installed", file=sys.stderr)
    sys.exit(77)

mp = mpmath.mp
mp.dps = 40
EPS = mpmath.mpf(2) ** -52
ORDER = 3
PLACES = [(i, j) for d in range(ORDER + 1) for i in range(d, -1, -1) for j in [d - i]]
INDEX = {place: k for k, place in enumerate(PLACES)}


class Undefined(Exception):
    pass


class Jet:
    """c[(i, j)]: coefficient of x^i y^j; e: bound of its error in double precision."""

    def __init__(self, c, e):
        self.c, self.e = c, e

    @staticmethod
    def number(x):
        return Jet([mpmath.mpf(x)] + [mpmath.mpf(0)] * 9, [EPS * abs(mpmath.mpf(x)) / 2] + [mpmath.mpf(0)] * 9)

    @staticmethod
    def coordinate(x, a):
        jet = Jet([mpmath.mpf(x)] + [mpmath.mpf(0)] * 9, [mpmath.mpf(0)] * 10)
        jet.c[1 + a] = mpmath.mpf(1)
        return jet

    def __add__(self, other):
        c = [a + b for a, b in zip(self.c, other.c)]
        return Jet(c, [a + b + EPS * abs(x) for a, b, x in zip(self.e, other.e, c)])

    def __neg__(self):
        return Jet([-a for a in self.c], self.e)

    def __mul__(self, other):
        c, e = [mpmath.mpf(0)] * 10, [mpmath.mpf(0)] * 10
        for k, (i, j) in enumerate(PLACES):
            for l, (m, n) in enumerate(PLACES):
                if i + j + m + n > ORDER:
                    continue
                to, product = INDEX[i + m, j + n], self.c[k] * other.c[l]
                c[to] += product
                e[to] += abs(self.c[k]) * other.e[l] + self.e[k] * abs(other.c[l]) + 2 * EPS * abs(product)
        return Jet(c, e)

    def compose(self, f, relative=4):
        """f: coefficients of the function's series at self.c[0], one more than ORDER + 1. They err as if they, and the place where they
        are taken, were wrong by `relative` EPS of their size."""
        d = Jet([mpmath.mpf(0)] + self.c[1:], [mpmath.mpf(0)] + self.e[1:])
        result, power = Jet.number(0), Jet.number(1)
        power.e = [mpmath.mpf(0)] * 10
        for k in range(ORDER + 1):
            factor = Jet([f[k]] + [mpmath.mpf(0)] * 9,
                         [(k + 1) * abs(f[k + 1]) * (self.e[0] + relative * EPS * abs(self.c[0])) + relative * EPS * abs(f[k])] + [mpmath.mpf(0)] * 9)
            result = result + factor * power
            power = power * d
        return result


def integrate(f0, rate):
    return [f0] + [r / (k + 1) for k, r in enumerate(rate)]


def series_power(x, r, n=ORDER + 3):
    """(x + d)^r"""
    f = [mpmath.power(x, r)]
    for k in range(n - 1):
        f.append(f[-1] * (r - k) / ((k + 1) * x))
    return f


def compose_series(outer, inner):
    """outer at inner[0]; both in d"""
    d, power, out = [mpmath.mpf(0)] + inner[1:], [mpmath.mpf(1)] + [mpmath.mpf(0)] * (len(inner) - 1), [mpmath.mpf(0)] * len(inner)
    for f in outer[:len(inner)]:
        out = [o + f * p for o, p in zip(out, power)]
        power = [sum(power[i] * d[k - i] for i in range(k + 1)) for k in range(len(inner))]
    return out


def riccati(t, sign):
    """T' = 1 + sign T^2"""
    f = [t]
    for k in range(ORDER + 1):
        f.append(((1 if k == 0 else 0) + sign * sum(f[i] * f[k - i] for i in range(k + 1))) / (k + 1))
    return f


def cycle(values, signs):
    f = []
    for k in range(ORDER + 2):
        f.append(signs[k % 4] * values[k % 2] / mpmath.factorial(k))
    return f


def square_series(x, sign):
    return [1 + sign * x * x, sign * 2 * x, mpmath.mpf(sign)] + [mpmath.mpf(0)] * 2


def function_series(name, x):
    if name == "exp":
        return cycle([mpmath.exp(x)] * 2, [1, 1, 1, 1])
    if name == "log":
        if x <= 0:
            raise Undefined
        return integrate(mpmath.log(x), series_power(x, -1)[:ORDER + 1])
    if name == "sqrt":
        if x <= 0:
            raise Undefined
        return series_power(x, mpmath.mpf(1) / 2)
    if name == "sin":
        return cycle([mpmath.sin(x), mpmath.cos(x)], [1, 1, -1, -1])
    if name == "cos":
        return cycle([mpmath.cos(x), mpmath.sin(x)], [1, -1, -1, 1])
    if name == "sinh":
        return cycle([mpmath.sinh(x), mpmath.cosh(x)], [1, 1, 1, 1])
    if name == "cosh":
        return cycle([mpmath.cosh(x), mpmath.sinh(x)], [1, 1, 1, 1])
    if name == "tan":
        return riccati(mpmath.tan(x), 1)
    if name == "tanh":
        return riccati(mpmath.tanh(x), -1)
    if name == "atan":
        s = square_series(x, 1)
        return integrate(mpmath.atan(x), compose_series(series_power(s[0], -1), s)[:ORDER + 1])
    if abs(x) >= 1:
        raise Undefined
    s = square_series(x, -1)
    rate = compose_series(series_power(s[0], -mpmath.mpf(1) / 2), s)[:ORDER + 1]
    return integrate(mpmath.asin(x), rate) if name == "asin" else integrate(mpmath.acos(x), [-r for r in rate])


FUNCTIONS = ["exp", "log", "sqrt", "sin", "cos", "sinh", "cosh", "tan", "tanh", "atan", "asin", "acos"]
SYMPY = {name: getattr(sympy, name) for name in FUNCTIONS}
u, v = sympy.symbols("u v", real=True)


class Writer:
    """A random expression: its text, its jet at the point, and a function that gives it to SymPy."""

    def __init__(self, rng, point):
        self.rng, self.point = rng, point

    def expression(self, depth):
        kind = self.rng.random()
        if depth == 0 or kind < 0.08:
            return self.leaf()
        if kind < 0.30:
            (a, x, s), (b, y, t) = self.expression(depth - 1), self.expression(depth - 1)
            if self.rng.random() < 0.5:
                return f"({a} + {b})", x + y, lambda: s() + t()
            return f"({a} - {b})", x + (-y), lambda: s() - t()
        if kind < 0.52:
            (a, x, s), (b, y, t) = self.expression(depth - 1), self.expression(depth - 1)
            return f"{a}*{b}", x * y, lambda: s() * t()
        if kind < 0.62:
            (a, x, s), (b, y, t) = self.expression(depth - 1), self.expression(depth - 1)
            if abs(y.c[0]) < 0.05:
                raise Undefined
            return f"{a}/({b})", x * y.compose(series_power(y.c[0], -1), 2), lambda: s() / t()
        if kind < 0.72:
            a, x, s = self.expression(depth - 1)
            n = self.rng.choice([-2, -1, 2, 3, 4, 5])
            if n < 0 and abs(x.c[0]) < 0.05 or x.c[0] == 0:
                raise Undefined
            return f"({a})^{n}", x.compose(series_power(x.c[0], n), 2 * abs(n)), lambda: s() ** n
        if kind < 0.77:
            a, x, s = self.expression(depth - 1)
            r = self.rng.choice(["0.5", "1.5", "-0.5", "2.5", "0.3", "1.7"])
            if x.c[0] < 0.05:
                raise Undefined
            # a power of any other exponent is exp(r log a)
            relative = 6 if float(r) * 2 == int(float(r) * 2) else 4 + 4 * abs(mpmath.mpf(r) * mpmath.log(x.c[0]))
            return f"({a})^{r}", x.compose(series_power(x.c[0], mpmath.mpf(r)), relative), lambda: s() ** sympy.Rational(r)
        if kind < 0.82:
            a, x, s = self.expression(depth - 1)
            return f"(-{a})", -x, lambda: -s()
        a, x, s = self.expression(depth - 1)
        name = self.rng.choice(FUNCTIONS)
        if abs(x.c[0]) > 30:
            raise Undefined
        return f"{name}({a})", x.compose(function_series(name, x.c[0])), lambda: SYMPY[name](s())

    def leaf(self):
        kind = self.rng.random()
        if kind < 0.35:
            return "u", Jet.coordinate(self.point[0], 0), lambda: u
        if kind < 0.7:
            return "v", Jet.coordinate(self.point[1], 1), lambda: v
        if kind < 0.75:
            return "pi", Jet.number(mpmath.pi), lambda: sympy.pi
        text = str(self.rng.randint(1, 400) / 100)
        return text, Jet.number(mpmath.mpf(text)), lambda: sympy.Rational(text)


def symbolic_differs(symbolic, point, numbers):
    at = {u: sympy.Rational(point[0]), v: sympy.Rational(point[1])}
    for (i, j), number in zip(PLACES, numbers):
        derivative = symbolic
        for symbol, times in ((u, i), (v, j)):
            if times:
                derivative = sympy.diff(derivative, symbol, times)
        value = mpmath.mpf(str(sympy.N(derivative.subs(at), 40)))
        if abs(value - number) > mpmath.mpf(10) ** -25 * (1 + abs(number)):
            return f"({i}, {j}): {value} by symbols, {number} by series"
    return ""


def main(arguments):
    if len(arguments) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    count, rng = int(arguments[0]), random.Random(int(arguments[1]))
    symbolic = int(arguments[2]) if len(arguments) == 3 else 0
    done = 0
    while done < count:
        point = [rng.randint(-96, 96) / 64 for _ in range(2)]  # exact in double precision
        try:
            text, jet, expression = Writer(rng, point).expression(rng.randint(1, 5))
        except (Undefined, ZeroDivisionError, ValueError, OverflowError):
            continue
        factor = [mpmath.factorial(i) * mpmath.factorial(j) for i, j in PLACES]
        numbers, errors = [f * c for f, c in zip(factor, jet.c)], [f * e for f, e in zip(factor, jet.e)]
        if any(not mpmath.isfinite(x) or abs(x) > 1e9 for x in numbers) or any(e > 1e-6 * (1 + abs(x)) for x, e in zip(numbers, errors)):
            continue
        if done < symbolic:
            difference = symbolic_differs(expression(), point, numbers)
            if difference:
                print(f"{text} at {point}: {difference}", file=sys.stderr)
                return 1
        print(text, repr(point[0]), repr(point[1]), " ".join(mpmath.nstr(x, 25) for x in numbers),
              " ".join(mpmath.nstr(e, 5) for e in errors), sep="\t")
        done += 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
