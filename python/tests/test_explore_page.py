"""The page of ``fret explore`` in a browser: what a hand does there solves the case, and is drawn and told."""

import json
import math
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
COATED = ROOT / "examples" / "coated_sphere.toml"
HERTZ = ROOT / "examples" / "hertz.toml"
CELLS = "24"
"""Cells along a side: an answer comes in some milliseconds."""


class Opened:
    """A page of ``fret explore``, with all that it asked and was told."""

    def __init__(self, page: Any, address: str) -> None:
        page.set_default_timeout(180_000)  # a busy machine is no fault
        self.page, self.address = page, address
        self.asked: list[str] = []
        self.faults: list[str] = []
        self.solved: list[tuple[Any, Any]] = []
        page.on("request", lambda request: self.asked.append(request.url))
        page.on("console", lambda said: self.faults.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        page.on("response", self._hear)
        page.goto(address)
        self.rest()

    def _hear(self, response: Any) -> None:
        if response.url.endswith("/solve"):
            self.solved.append((json.loads(response.request.post_data), response.json()))

    def rest(self) -> None:
        """Wait until the page has drawn what it was asked last: by its own word, not by the clock."""
        self.page.wait_for_selector(".seen[aria-busy=false]")

    def slider(self, key: str) -> Any:
        """Return the slider of a key."""
        return self.page.locator(f".slide:has(label[title='{key}']) input[type=range]")

    def number(self, key: str) -> Any:
        """Return the number beside it."""
        return self.page.locator(f".slide:has(label[title='{key}']) input[type=number]")

    def told(self) -> dict[str, str]:
        """Return the numbers of the page by name."""
        cards = self.page.locator("#numbers > div").all()
        return {card.locator("dt").inner_text(): card.locator("dd").inner_text() for card in cards}

    def as_answered(self) -> dict[str, float]:
        """Return what was asked last, once the page tells what was answered."""
        question, answer = self.solved[-1]
        assert answer["status"] == "solved"
        told = self.told()
        for _, name, value in answer["numbers"]:
            assert told[name] == value, name
        values: dict[str, float] = question["values"]
        return values


Open = Callable[..., Opened]


def read(words: str) -> float:
    """Return a number as the page writes it, such as 1.5 · 10⁻⁶."""
    number, _, power = words.replace("\N{NO-BREAK SPACE}", " ").partition(" · 10")
    digits = power.split(" ")[0].translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-"))
    return float(number.split(" ")[0].rstrip("%")) * 10.0 ** int(digits or 0)


@contextmanager
def served(case: Path) -> Iterator[str]:
    """Serve a case; end with the block."""
    call = [sys.executable, "-m", "fretting", "explore", str(case), "--cells", CELLS, "--threads", "1"]
    with subprocess.Popen(call, stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        try:
            yield run.stdout.readline().split()[-1]
        finally:
            run.terminate()


@pytest.fixture
def opened(browser: Any) -> Iterator[Open]:
    """Return what opens a case in the browser; what it opened is closed."""
    todo: list[Any] = []

    def open_page(case: Path = COATED, **settings: Any) -> Opened:
        service = served(case)
        address = service.__enter__()
        todo.append(service)
        return Opened(browser.new_page(**settings), address)

    yield open_page
    for service in todo:
        service.__exit__(None, None, None)
    for context in browser.contexts:
        context.close()


def test_a_dragged_slider_solves_and_draws_what_it_shows(opened: Open) -> None:
    seen = opened()
    figures = {name: seen.page.locator(f"#{name}").inner_html() for name in ("loop", "section", "zones", "pressure")}
    before = seen.told()
    key = "friction.coefficient"
    box = seen.slider(key).bounding_box()
    middle = box["y"] + box["height"] / 2
    start = seen.page.evaluate("range => range.value / range.max", seen.slider(key).element_handle())
    seen.page.mouse.move(box["x"] + start * box["width"], middle)
    seen.page.mouse.down()
    for step in range(1, 13):
        seen.page.mouse.move(box["x"] + (start + 0.03 * step) * box["width"], middle)
    seen.page.mouse.up()
    seen.rest()
    assert seen.as_answered() == {key: float(seen.number(key).input_value())}
    # more was drawn than the end alone, and no more asked than the mouse moved
    assert 2 <= len(seen.solved) <= 1 + 12 + 2
    # more friction: less slip at the same force, and so less energy
    after = seen.told()
    assert read(after["energy W_d per cycle"]) < read(before["energy W_d per cycle"])
    assert read(after["stick fraction"]) > read(before["stick fraction"])
    for name in ("loop", "section", "zones"):
        assert seen.page.locator(f"#{name}").inner_html() != figures[name], name
    assert not seen.faults


def test_a_typed_number_gives_the_contact_of_hertz(opened: Open) -> None:
    seen = opened(HERTZ)
    case = tomllib.loads(HERTZ.read_text(encoding="utf-8"))
    force, radius = f"load.{case['load'][0]['name']}.normal_force", case["profile"]["sphere"]["radius"]
    typed = 2.5 * case["load"][0]["normal_force"]
    seen.number(force).fill(str(typed))
    seen.number(force).press("Enter")
    seen.rest()
    assert seen.as_answered() == {force: typed}
    bodies = [case[body]["substrate"] for body in ("upper", "lower")]
    modulus = 1 / sum((1 - body["poisson"] ** 2) / body["young"] for body in bodies)
    pressure = (6 * typed * modulus**2 / (math.pi**3 * radius**2)) ** (1 / 3)
    # 24 cells, ten or so along the radius: the error is that of the page of grids, below 1 %
    assert seen.solved[-1][1]["raw"]["max_pressure"] == pytest.approx(pressure, rel=0.01)
    assert read(seen.told()["max pressure"]) == pytest.approx(pressure, rel=0.01)


def test_the_keyboard_moves_a_slider(opened: Open) -> None:
    seen = opened()
    # Tab reaches the first number, then its slider.
    seen.page.keyboard.press("Tab")
    seen.page.keyboard.press("Tab")
    first = seen.page.evaluate("document.activeElement.id")
    assert first == "slider-0"
    key = seen.page.locator(".slide label").first.get_attribute("title")
    before = float(seen.number(key).input_value())
    for _ in range(20):
        seen.page.keyboard.press("ArrowRight")
    seen.rest()
    after = float(seen.number(key).input_value())
    assert after > before
    assert seen.as_answered() == {key: after}
    spoken = seen.slider(key).get_attribute("aria-valuetext")
    assert float(spoken.split()[0]) == after
    # back by the button
    seen.page.locator("#reset").focus()
    seen.page.keyboard.press("Enter")
    seen.rest()
    assert float(seen.number(key).input_value()) == before
    assert seen.as_answered() == {}


def test_the_dot_goes_along_the_loop(opened: Open) -> None:
    seen = opened()
    dot = seen.page.locator("#loop .here")
    before = [dot.get_attribute(name) for name in ("cx", "cy")]
    seen.page.locator("#moment").focus()
    seen.page.keyboard.press("Home")
    seen.rest()
    question, answer = seen.solved[-1]
    assert question["moment"] == 0 == answer["moment"]
    assert [dot.get_attribute(name) for name in ("cx", "cy")] != before


def test_the_case_is_written_with_the_number_of_the_slider(opened: Open) -> None:
    seen = opened()
    seen.number("friction.coefficient").fill("0.37")
    seen.number("friction.coefficient").press("Enter")
    seen.rest()
    with seen.page.expect_download() as download:
        seen.page.locator("#write").click()
    written = tomllib.loads(Path(download.value.path()).read_text(encoding="utf-8"))
    expected = tomllib.loads(COATED.read_text(encoding="utf-8"))
    expected["friction"]["coefficient"] = 0.37
    assert written == expected
    assert download.value.suggested_filename == "coated_sphere-explored.toml"


def test_what_the_case_cannot_have_is_told_and_taken_back(opened: Open) -> None:
    seen = opened()
    seen.number("friction.coefficient").fill("0.01")  # less than the force takes
    seen.number("friction.coefficient").press("Enter")
    seen.rest()
    trouble = seen.page.locator("#trouble")
    assert trouble.is_visible() and "friction" in trouble.inner_text()
    seen.page.locator("#reset").click()
    seen.rest()
    assert not trouble.is_visible()
    assert seen.as_answered() == {}


def test_a_phone_scrolls_downwards_alone(opened: Open) -> None:
    seen = opened(viewport={"width": 390, "height": 844}, has_touch=True)
    assert seen.page.evaluate("document.scrollingElement.scrollWidth") <= 390
    widths = seen.page.evaluate(
        "[...document.querySelectorAll('.slide')].map(slide => slide.getBoundingClientRect().right)"
    )
    assert widths and max(widths) <= 390
    # every slider can be reached, below what is seen
    last = seen.page.locator(".slide input[type=range]").last
    last.scroll_into_view_if_needed()
    assert last.is_visible()
    assert seen.page.locator("#figure-loop").is_visible()


def test_the_page_is_dark_where_the_reader_wants_it(opened: Open) -> None:
    def ground(seen: Opened) -> tuple[list[int], list[int]]:
        style = seen.page.evaluate(
            "(({color, backgroundColor}) => [color, backgroundColor])(getComputedStyle(document.body))"
        )
        ink, paper = ([int(part) for part in re.findall(r"\d+", colour)[:3]] for colour in style)
        return ink, paper

    for scheme in ("light", "dark"):
        ink, paper = ground(opened(color_scheme=scheme))
        assert (sum(paper) < sum(ink)) == (scheme == "dark")
        assert abs(sum(paper) - sum(ink)) > 450


def test_nobody_but_the_command_is_asked(opened: Open) -> None:
    seen = opened()
    assert len(seen.asked) >= 3  # the page, the solution, the stress below
    assert [url for url in seen.asked if not url.startswith((seen.address, "data:"))] == []
    # The page itself forbids what it does not do.
    refused = seen.page.evaluate("fetch('http://127.0.0.1:9/').then(() => 'answered', error => error.name)")
    assert refused == "TypeError"
