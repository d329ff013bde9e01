#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Build the manual: the READMEs, the pages of this folder, and a reference of ents.h, as HTML with a search.

usage: manual.py --version X.Y.Z --out FOLDER        -> FOLDER/html/README.html

Dead links and names of files that do not exist are errors.
exit status: 0 done; 1 a text has a mistake; 2 wrong command line; 3 a program is missing (Debian: python3-sphinx python3-myst-parser
python3-breathe python3-sphinx-rtd-theme doxygen pandoc)"""
import argparse
import ast
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CHAPTERS = {  # title in the list of contents: texts
    "Learn": ["abi/manual/theory", "abi/README", "core/README", "abi/manual/reference"],
    "Host programs": ["adapters/README", "adapters/python/README", "abi/manual/python", "adapters/deck/README", "adapters/calculix/README"],
    "Maintain": [".github/CONTRIBUTING", "abi/manual/decisions", "abi/manual/changes", "tests/configurations/README", "abi/manual/cite"],
    "Examples and evidence": ["examples/README", "examples/host/README", "examples/laboratory/README", "examples/slide/README", "tests/README", "tests/bench/README"],
}
IN_CONTENTS = {"README", *(name for names in CHAPTERS.values() for name in names)}
REFERENCE = """# Reference: ents.h

Every function, struct and constant of [ents.h](../ents.h), from its own comments. Conventions and the order of a segment's nodes stand
at the top of that file.

```{eval-rst}
.. doxygenfile:: ents.h
   :sections: func define enum innerclass public-attrib briefdescription detaileddescription
```
"""
PYTHON = """# Reference: Python

Classes of the package [ents](../../adapters/python/README.md), from its own texts (`help(ents)` shows the same).
"""
CONF = """project, release = "ents", "{version}"
extensions = ["myst_parser", "breathe"]
root_doc = "README"
html_theme = "sphinx_rtd_theme"
html_show_copyright = False
html_show_sphinx = False
breathe_projects = {{"ents": "{xml}"}}
breathe_default_project = "ents"
breathe_domain_by_extension = {{"h": "c"}}
myst_heading_anchors = 4
html_static_path = ["_static"]
html_css_files = ["ents.css"]
"""
DOXYFILE = """PROJECT_NAME = ents
INPUT = {root}/abi/ents.h
INPUT_FILTER = "{python} {here}/doxygen_filter.py"
OUTPUT_DIRECTORY = {out}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
QUIET = YES
EXTRACT_ALL = YES
OPTIMIZE_OUTPUT_FOR_C = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = ENTS_API=
WARN_IF_UNDOCUMENTED = NO
"""
CSS = """.wy-nav-content { max-width: 980px; }
.wy-table-responsive table td, .wy-table-responsive table th { white-space: normal; }
.formula { overflow-x: auto; margin-bottom: 24px; }
@media (max-width: 480px) { .rst-content table.docutils td, .rst-content table.docutils th { padding: 6px !important; } }
.rst-content .highlight-text pre, .rst-content .highlight-python pre, .rst-content .highlight-none pre,
.rst-content .highlight-json pre { white-space: pre-wrap !important; }
"""
LINK = re.compile(r"(!?\[)([^\]]*)\]\(([^)\s#]*)((?:#[^)\s]*)?)\)")


def mathml(text):
    """The formulas between dollars as MathML, which browsers draw without a script or a network."""
    formulas = [m[1] or m[2] for m in re.finditer(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", text, re.S)]
    if not formulas:
        return text
    source = "\n\n".join(f"$${f}$$" if f"$${f}$$" in text else f"${f}$" for f in formulas)
    done = subprocess.run(["pandoc", "-f", "markdown", "-t", "html", "--mathml"], input=source, capture_output=True, text=True, check=True).stdout
    done = re.sub(r'<mo stretchy="true" form="(pre|post)fix">([()])</mo>', r'<mo stretchy="false">\2</mo>', done)
    drawn = iter(re.findall(r"<math.*?</math>", done, re.S))

    def one(match):
        element = next(drawn).replace("\n", " ").replace("|", "&#124;")  # a bar would end the cell of a table
        return f'\n<div class="formula">{element}</div>\n' if match[1] else element
    return re.sub(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", one, text, flags=re.S)


def markdown(text):
    """A text of the Python package: lines with a name and two blanks become a list, indented lines code, the rest paragraphs."""
    def escape(part):
        return re.sub(r"(`[^`]*`)|([\\*_\[\]<>#~])", lambda m: m[1] or "\\" + m[2], part.strip())

    out, listed = [], False
    for line in (text or "").splitlines():
        entry = re.match(r"(\w[\w, .]*?)  +(\S.*)", line)
        code = line.startswith("    ") and not listed
        if entry:
            out += ([] if listed else [""]) + [f"- `{entry[1]}` {escape(entry[2])}"]
        elif line.strip() and not code and out and out[-1] and listed == line.startswith(" "):
            out[-1] += " " + escape(line)
        else:
            out += [line] if code or not line.strip() else ["", escape(line)]
        listed = bool(entry) or listed and line.startswith(" ")
    return "\n".join(out)


def python_reference():
    """Classes and public methods of the Python package, with their texts."""
    out = [PYTHON]
    for name in ("contact", "_model", "_surface", "_system", "_library"):
        for node in ast.parse((ROOT / "adapters" / "python" / "ents" / f"{name}.py").read_text()).body:
            if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
                continue
            methods = {m.name: m for m in node.body if isinstance(m, ast.FunctionDef)}
            parameters = ast.unparse(methods["__init__"].args).removeprefix("self").lstrip(", ") if "__init__" in methods else ""
            out.append(f"## {node.name}\n\n```python\nents.{node.name}({parameters})\n```\n\n{markdown(ast.get_docstring(node))}\n")
            for method in methods.values():
                if not method.name.startswith("_"):
                    parameters = ast.unparse(method.args).removeprefix("self").lstrip(", ")
                    out.append(f"### {node.name}.{method.name}\n\n```python\n{method.name}({parameters})\n```\n\n{markdown(ast.get_docstring(method))}\n")
    return "\n".join(out)


def copy_text(name, source):
    """One text into the folder of Sphinx: links to folders become links to their READMEs; files that are linked come along."""
    file = ROOT / f"{name}.md"
    text = python_reference() if name.endswith("manual/python") else REFERENCE if name.endswith("manual/reference") else file.read_text()

    def follow(match):
        target = match[3]
        if not target or re.match(r"[a-z]+:", target):
            return match[0]
        path = (file.parent / target).resolve()
        if path.is_dir():
            readme = path / "README.md"
            if not readme.exists():
                return match[2]  # a folder of sources alone: its name
            target, path = f"{target.rstrip('/')}/README.md", readme
        if not path.exists():
            sys.exit(f"manual.py: {name}.md links to {target}, which does not exist")
        copy = source / path.relative_to(ROOT)
        if path.suffix != ".md" and not copy.exists():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)
        linked.add(str(path.relative_to(ROOT).with_suffix("")) if path.suffix == ".md" else name)
        return f"{match[1]}{match[2]}]({target}{match[4]})"

    parts = re.split(r"(^```.*?^```$|`[^`\n]*`)", text, flags=re.S | re.M)  # no links and formulas in code
    parts[::2] = [LINK.sub(follow, part) for part in parts[::2]]
    text = "".join(parts)
    copy = source / f"{name}.md"
    copy.parent.mkdir(parents=True, exist_ok=True)
    if name not in IN_CONTENTS:
        text = "---\norphan: true\n---\n" + text
    copy.write_text(mathml(text) if name.endswith("theory") else text)


linked = set()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    given = parser.parse_args()
    missing = [program for program in ("doxygen", "pandoc") if not shutil.which(program)]
    for module in ("sphinx", "myst_parser", "breathe", "sphinx_rtd_theme"):
        try:
            __import__(module)
        except ImportError:
            missing.append(module)
    if missing:
        print(f"manual.py: not built: {', '.join(missing)} missing; see --help for the Debian packages")
        return 3

    out = given.out.resolve()
    source = out / "source"
    shutil.rmtree(out, ignore_errors=True)
    source.mkdir(parents=True)
    done, wanted = set(), set(IN_CONTENTS)
    while wanted - done:  # what is linked is a page, too
        for name in sorted(wanted - done):
            copy_text(name, source)
            done.add(name)
        wanted |= linked
    contents = "".join(f"\n```{{toctree}}\n:hidden:\n:caption: {title}\n" + "".join(f"/{name}\n" for name in names) + "```\n"
                       for title, names in CHAPTERS.items())
    top = source / "README.md"
    top.write_text(top.read_text() + contents)

    (out / "Doxyfile").write_text(DOXYFILE.format(root=ROOT, here=HERE, out=out, python=sys.executable))
    (source / "conf.py").write_text(CONF.format(version=given.version, xml=out / "xml"))
    (source / "_static").mkdir()
    (source / "_static" / "ents.css").write_text(CSS)
    subprocess.run(["doxygen", out / "Doxyfile"], check=True)
    result = subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", source, out / "html"])
    if result.returncode:
        return 1
    shown = (out / "html" / "abi" / "manual" / "reference.html").read_text()
    functions = re.findall(r"(?m)^ENTS_API .*?\b(ents_\w+)\(", (ROOT / "abi" / "ents.h").read_text())
    lost = [name for name in functions if f">{name}<" not in shown]
    if lost or not functions or not (out / "html" / "searchindex.js").exists():
        print(f"manual.py: the reference does not show {', '.join(lost) or 'anything'}", file=sys.stderr)
        return 1
    print(f"{out / 'html' / 'README.html'}: {len(done)} pages, {len(functions)} functions in the reference")
    return 0


if __name__ == "__main__":
    sys.exit(main())
