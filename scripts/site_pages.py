"""Makes the web site of scripts/site: lays the pages out in a folder, has Sphinx write them, and checks every link of the result."""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"(!?)\[([^\[\]]*)\]\(([^)\s]+)\)")
MARK = ".made-by-touchafm"
FENCE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)


def listed_pages():
    """The parts of the side bar: title and pages. The start page is the README."""
    with open(ROOT / "docs/site/contents.toml", "rb") as file:
        parts = tomllib.load(file)["part"]
    seen = {ROOT / "README.md"}
    result = []
    for part in parts:
        pages = []
        for pattern in part["pages"]:
            found = [page for page in sorted(ROOT.glob(pattern)) if page not in seen]
            if not found:
                sys.exit(f"error: docs/site/contents.toml lists {pattern}, which names no page that is not listed before it")
            seen.update(found)
            pages += found
        result.append((part["title"], pages))
    tracked = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "docs/*.md"], cwd=ROOT, check=True, stdout=subprocess.PIPE,
                             text=True).stdout.split()
    forgotten = [name for name in tracked if (ROOT / name).is_file() and ROOT / name not in seen]
    if forgotten:
        sys.exit("error: docs/site/contents.toml lacks " + ", ".join(forgotten))
    return result


def place_of(page):
    """Where a page lies in the site: the folder docs is its root."""
    if page == ROOT / "README.md":
        return pathlib.PurePosixPath("index.md")
    relative = page.relative_to(ROOT)
    return pathlib.PurePosixPath(*relative.parts[1:]) if relative.parts[0] == "docs" else pathlib.PurePosixPath(relative)


def link_between(place, target):
    """The relative address of one place of the site, seen from another."""
    up = len(place.parent.parts)
    return "../" * up + str(target)


def site_link(page, places, address):
    """An address of a page as the site has it; None where it leads to a file of the tree that the site does not show."""
    if re.match(r"[a-z]+:", address) or address.startswith("#"):
        return address
    path, _, fragment = address.partition("#")
    target = (page.parent / path).resolve()
    if not target.exists():
        sys.exit(f"error: {page.relative_to(ROOT)} links to {path}, which does not exist")
    if target.is_relative_to(ROOT / "docs/pictures"):
        return link_between(places[page], place_of(target))
    if target not in places:
        return None
    return link_between(places[page], places[target]) + ("#" + fragment if fragment else "")


def with_site_links(page, places, text):
    def rewrite(match):
        sort, words, address = match.groups()
        there = site_link(page, places, address)
        return f"{sort}[{words}]({there})" if there else words

    return "".join(piece if piece.startswith("```") else LINK.sub(rewrite, piece) for piece in FENCE.split(text))


def side_bar(parts, places):
    lines = []
    for title, pages in parts:
        lines += ["", "```{toctree}", ":hidden:", f":caption: {title}", ""]
        lines += [str(places[page].with_suffix("")) for page in pages]
        lines.append("```")
    return "\n".join(lines) + "\n"


def lay_out(folder):
    parts = listed_pages()
    pages = [ROOT / "README.md"] + [page for _, pages in parts for page in pages]
    places = {page: place_of(page) for page in pages}
    for page, place in places.items():
        text = with_site_links(page, places, page.read_text())
        if place.name == "index.md":
            text += side_bar(parts, places)
        (folder / place).parent.mkdir(parents=True, exist_ok=True)
        (folder / place).write_text(text)
    shutil.copytree(ROOT / "docs/pictures", folder / "pictures")
    shutil.copy(ROOT / "docs/site/conf.py", folder)
    (folder / "_static").mkdir()
    shutil.copy(ROOT / "docs/site/site.css", folder / "_static")
    return len(pages)


class Page(html.parser.HTMLParser):
    """The names of a page's places, and the addresses that it refers to."""

    def __init__(self, text):
        super().__init__()
        self.names, self.addresses = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names.update(value for key, value in attributes if key == "id" or (key == "name" and tag == "a"))
        self.addresses += [values[key] for key in ("href", "src") if values.get(key)]


def dead_links(site):
    pages = {path: Page(path.read_text()) for path in site.rglob("*.html")}
    dead = []
    for path, page in pages.items():
        for address in page.addresses:
            parts = urllib.parse.urlsplit(address)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            fragment = urllib.parse.unquote(parts.fragment)
            if not target.exists() or (fragment and target in pages and fragment not in pages[target].names):
                dead.append(f"{path.relative_to(site)}: {address}")
    return dead


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    if site.exists() and not (site / MARK).exists():
        sys.exit(f"error: {site} exists and is no site of ours: nothing is replaced; name a folder that does not exist")
    with tempfile.TemporaryDirectory() as folder:
        source, made = pathlib.Path(folder, "source"), pathlib.Path(folder, "site")
        source.mkdir()
        count = lay_out(source)
        subprocess.run(["/usr/bin/sphinx-build", "-q", "-W", "--keep-going", "-b", "html", str(source), str(made)], check=True)
        dead = dead_links(made)
        if dead:
            sys.exit("error: links that lead nowhere:\n" + "\n".join(dead))
        for leftover in (".doctrees", ".buildinfo"):
            path = made / leftover
            shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
        shutil.rmtree(site, ignore_errors=True)
        site.parent.mkdir(parents=True, exist_ok=True)
        (made / MARK).touch()
        shutil.copytree(made, site)
    print(f"{count} pages, every link and picture found: {site / 'index.html'}")


main()
