# SPDX-License-Identifier: BSD-3-Clause
"""usage: python3 -m ents generate EXPRESSION [--name NAME] [--constant NAME=NUMBER]... [--parameter NAME]... [--dimension 1|2]

Prints a height function in C for ents_height_register: h and its derivatives to the third order, from SymPy's derivatives with common
subexpressions taken out.

  EXPRESSION     of u (and v) in the language of {"type": "expression"}: "a*sin(2*pi*u)*exp(-v^2)"; without bump
  --name         of the function; default: height
  --constant     a name in the expression and its number; may be given several times
  --parameter    a name whose value is read from user_data, an array of doubles in the order of these options
  --dimension    surface coordinates; default: 2 if the expression has v, else 1

  python3 -m ents generate "a*sin(2*pi*u)" --constant a=0.01 --name wave > wave.c
  cc -O2 -ffp-contract=off -shared -fPIC wave.c -o libwave.so -lm

exit status: 0 done; 1 SymPy is missing; 2 wrong command line or expression"""
import argparse
import re

FUNCTIONS = ("exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan", "sqrt")


class Wrong(Exception):
    pass


def derivatives(dimension):
    """Orders by (u, v) of the numbers of a jet, in their order."""
    return [(total - j, j) for total in range(4) for j in (range(total + 1) if dimension == 2 else [0])]


def c_function(text, name="height", constants=None, parameters=(), dimension=None):
    """The source. constants: {name: number}."""
    import sympy

    if not re.fullmatch(r"[\w\s.+\-*/^(),]*", text, re.ASCII):
        raise Wrong(f"'{text}': characters that no expression has; see python3 -m ents generate --help")
    words = set(re.findall(r"(?<![\w.])[A-Za-z_]\w*", text))
    known = {"u", "v", "pi", *FUNCTIONS, *(constants or {}), *parameters}
    if words - known:
        raise Wrong(f"{', '.join(sorted(words - known))}: unknown; there are u, v, pi, {', '.join(FUNCTIONS)}; name others with --constant or --parameter")
    names = {word: sympy.Symbol(word, real=True) for word in ("u", "v", *(constants or {}), *parameters)}
    names.update({word: getattr(sympy, word) for word in ("pi", *FUNCTIONS)})
    try:
        h = sympy.sympify(text.replace("^", "**"), locals=names, rational=True)
        if not isinstance(h, sympy.Expr):
            raise TypeError
    except (sympy.SympifyError, SyntaxError, TypeError) as error:
        raise Wrong(f"'{text}' is no expression: {error}") from None
    u, v = names["u"], names["v"]
    dimension = dimension or (2 if h.has(v) else 1)
    if dimension == 1 and h.has(v):
        raise Wrong("the expression has v, and --dimension is 1")
    orders = derivatives(dimension)
    common, jet = sympy.cse([sympy.diff(h, u, i, v, j) if i + j else h for i, j in orders], symbols=sympy.numbered_symbols("x"))
    product = lambda base, power: "*".join([f"({base})"] * int(power))
    powers = {"Pow": [(lambda base, power: power in (2, 3, 4), product), (lambda base, power: power == sympy.Rational(1, 2), lambda base, _: f"sqrt({base})"),
                      (lambda base, power: power == -1, lambda base, _: f"1.0/({base})"), (lambda *_: True, "pow")]}
    code = lambda value: sympy.ccode(value, user_functions=powers).replace("M_PI", "pi")
    least = sum(i + j < 3 for i, j in orders)  # numbers that are always wanted, and what they need
    needed = set().union(*(value.free_symbols for value in jet[:least]))
    for symbol, value in reversed(common):
        if symbol in needed:
            needed |= value.free_symbols
    define = lambda first: [f"    const double {symbol} = {code(value)};" for symbol, value in common if (symbol in needed) == first]
    assign = lambda places: [f"    jet[{place} * count + k] = {code(jet[place])};" for place in places]
    lines = define(True) + assign(range(least)) + ["    if (order < 3) continue;"] + define(False) + assign(range(least, len(orders)))
    read = [f"  const double {word} = {float(number)!r};" for word, number in (constants or {}).items()]
    read += [f"  const double {word} = ((const double *)user_data)[{k}];" for k, word in enumerate(parameters)]
    return "\n".join([
        f"/* h = {text}", " * made by python3 -m ents generate */", "#include <math.h>", "#include <stdint.h>", "",
        f"int32_t {name}(void *user_data, int32_t order, int32_t count, const double *s, double *jet) {{",
        "  const double pi = 3.14159265358979323846;", *read,
        "  (void)pi, (void)user_data;" + "".join(f" (void){word};" for word in (*(constants or {}), *parameters)),
        "  for (int32_t k = 0; k < count; ++k) {", f"    const double u = s[k]{', v = s[count + k]' if dimension == 2 else ''};",
        f"    (void)u{', (void)v' if dimension == 2 else ''};", *lines, "  }", "  return 0;", "}", ""])


def main(arguments):
    parser = argparse.ArgumentParser(prog="python3 -m ents generate", add_help=False, allow_abbrev=False)
    parser.add_argument("expression")
    parser.add_argument("--name", default="height")
    parser.add_argument("--constant", action="append", default=[])
    parser.add_argument("--parameter", action="append", default=[])
    parser.add_argument("--dimension", type=int, choices=(1, 2))
    if set(arguments) & {"-h", "--help"}:
        print(__doc__)
        return 0
    given = parser.parse_args(arguments)
    try:
        constants = {}
        for text in given.constant:
            word, _, number = text.partition("=")
            try:
                constants[word] = float(number)
            except ValueError:
                raise Wrong(f"--constant {text}: NAME=NUMBER is expected") from None
        for word in (given.name, *constants, *given.parameter):
            if not re.fullmatch(r"[A-Za-z_]\w*", word, re.ASCII) or word in ("u", "v", "pi", "s", "k", "jet", "order", "count", "user_data", *FUNCTIONS):
                raise Wrong(f"'{word}' is no name for this: letters, digits and _, and none that the function has already")
        print(c_function(given.expression, given.name, constants, given.parameter, given.dimension), end="")
    except ImportError:
        print("generate needs SymPy: apt-get install python3-sympy, or python3 -m pip install sympy")
        return 1
    except Wrong as error:
        parser.exit(2, f"python3 -m ents generate: {error}\n")
    return 0
