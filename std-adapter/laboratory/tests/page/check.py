#!/usr/bin/env python3
"""Opens a simulation's report in headless Chromium, uses it as a reader would, and takes screenshots. See README.md."""

import argparse
import io
import sys
import tempfile
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page, TimeoutError, sync_playwright

# Use software rendering if there is no graphics card.
FLAGS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
# Each has a name, a theme and a size of the window.
VIEWS = [("light", "light", 1200, 850), ("dark", "dark", 1200, 850), ("narrow", "light", 390, 800)]

problems: list[str] = []


def expect(holds: bool, what: str) -> None:
    if not holds:
        problems.append(what)


def colours(page: Page) -> int:
    """Returns the number of colours in the animation."""
    image = Image.open(io.BytesIO(page.locator("#view").screenshot())).convert("RGB")
    return len(image.getcolors(maxcolors=1 << 24))


def frame(page: Page) -> int:
    return int(page.locator("#scrub").input_value())


def picture(page: Page) -> bytes:
    page.wait_for_timeout(300)
    return page.locator("#view").screenshot()


def use(page: Page) -> None:
    """Uses the page as a reader would, with keys alone."""
    last = int(page.locator("#scrub").get_attribute("max") or 0)
    expect(page.locator("#no-view").is_hidden(), "the animation is not drawn: no WebGL 2")
    expect(colours(page) > 200, "the animation is blank")
    for chart in page.locator(".chart").all():
        expect(chart.locator("path").count() > 0, f"chart {chart.get_attribute('data-kind')} is empty")
    page.evaluate("document.activeElement.blur()")
    expect(frame(page) == 0, "the first frame is not the first")
    if last > 1:
        page.keyboard.press(".")
        page.keyboard.press(".")
        expect(frame(page) == 2, "two steps forward do not lead to frame 2")
        page.keyboard.press(",")
        expect(frame(page) == 1, "a step back does not lead to frame 1")
        page.keyboard.press(" ")
        try:
            page.wait_for_function("document.getElementById('scrub').value !== '1'", timeout=60_000)
        except TimeoutError:
            problems.append("nothing plays")
        page.keyboard.press(" ")
        stopped = frame(page)
        page.wait_for_timeout(400)
        expect(frame(page) == stopped, "a pause does not pause")
        page.locator("#scrub").focus()
        page.keyboard.press("End")
        expect(frame(page) == last, "the slider's End key does not lead to the end")
    page.locator("#view").focus()
    before = picture(page)
    page.keyboard.press("ArrowLeft")
    turned = picture(page)
    expect(turned != before, "an arrow key does not turn the view")
    page.keyboard.press("+")
    expect(picture(page) != turned, "+ does not zoom")
    page.keyboard.press("Home")
    expect(picture(page) == before, "Home does not bring the first view back")
    page.locator("#edges").check()
    expect(picture(page) != before, "edges are not drawn")
    page.locator("#edges").uncheck()
    chart = page.locator(".chart svg").first
    if last > 1 and chart.count():
        box = chart.bounding_box()
        chart.click(position={"x": box["width"] / 2, "y": box["height"] / 2})
        expect(0 < frame(page) < last, "a click on a chart does not lead to its time")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=Path, help="a report, as `selvedge simulate` writes it")
    parser.add_argument("--output", type=Path, help="folder for the screenshots (a new one under the system's temporary folder)")
    parser.add_argument("--frame", type=int, help="the frame to show in the screenshots (three quarters through)")
    parser.add_argument("--chromium", default="/usr/bin/chromium", help="the browser")
    options = parser.parse_args()
    folder = options.output or Path(tempfile.mkdtemp(prefix="selvedge-page-"))
    folder.mkdir(parents=True, exist_ok=True)

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=options.chromium, args=[*FLAGS, "--no-sandbox"])
        for name, theme, width, height in VIEWS:
            page = browser.new_page(
                viewport={"width": width, "height": height}, color_scheme=theme, reduced_motion="reduce"
            )
            # Software rendering is slow on a busy machine.
            page.set_default_timeout(120_000)
            page.on("console", lambda message: problems.append(f"console: {message.type}: {message.text}"))
            page.on("pageerror", lambda error: problems.append(f"script: {error}"))
            own = options.page.resolve().as_uri()
            page.on("request", lambda request: expect(request.url.startswith(("data:", own)), f"requests {request.url}"))
            page.goto(own)
            page.wait_for_timeout(1000)
            overflow = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
            expect(overflow <= 0, f"{name}: the page is {overflow} pixels wider than the window")
            if name == "light":
                use(page)
            last = int(page.locator("#scrub").get_attribute("max") or 0)
            shown = min(last, options.frame if options.frame is not None else 3 * last // 4)
            page.evaluate(
                "(frame) => { const s = document.getElementById('scrub'); s.value = frame; s.dispatchEvent(new Event('input')); }",
                shown,
            )
            page.wait_for_timeout(500)
            page.screenshot(path=folder / f"{name}.png", full_page=True)
            page.close()

        # The numbers must be there without scripts and without WebGL.
        for name, arguments, settings in [
            ("without-scripts", [], {"java_script_enabled": False}),
            ("without-webgl", ["--disable-gpu", "--disable-3d-apis"], {}),
        ]:
            poor = playwright.chromium.launch(executable_path=options.chromium, args=[*arguments, "--no-sandbox"])
            page = poor.new_page(viewport={"width": 1200, "height": 850}, **settings)
            page.goto(own)
            page.wait_for_timeout(500)
            expect(page.locator("#no-view").is_visible(), f"{name}: nothing says why there is no animation")
            expect(page.locator("table tbody tr").count() > 0, f"{name}: there are no tables")
            page.screenshot(path=folder / f"{name}.png")
            poor.close()
        browser.close()

    print(f"screenshots: {folder}")
    for problem in problems:
        print(f"problem: {problem}")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
