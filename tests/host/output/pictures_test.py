#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What pictures.py and chart.py draw: ranges, orders, colours, notes that do not meet, numbers inside the page.

    python3 tests/host/output/pictures_test.py EXAMPLES_LABORATORY

Exit status 3: there is no matplotlib."""
import math
import pathlib
import sys
import unittest

LABORATORY = pathlib.Path(sys.argv.pop(1))
sys.path[:0] = [str(LABORATORY / "output"), str(LABORATORY / "chart")]
sys.dont_write_bytecode = True
import pictures  # noqa: E402
import chart  # noqa: E402


def axis(**more):
    return {"label": "x", "unit": "", "logarithmic": False, "min": None, "max": None, "tic_step": 0, **more}


def a_chart(curves, **more):
    filled = [{"label": "force", "style": "both", "fit_order": False, **curve} for curve in curves]
    return {"name": "chart", "title": "t", "subtitle": "", "x": axis(), "y": axis(), "curves": filled, "guides": [],
            "slope_triangle": 0, "equal_axes": False, **more}


def a_map(values, **more):
    return {"title": "p", "unit": "MPa", "columns": 3, "rows": 2, "values": values, "at_nodes": False, "blank_zero": False, "clip": 1,
            "palette": "viridis", **more}


def maps_of(fields):
    return {"name": "maps", "title": "pressure", "subtitle": "", "x_label": "x", "y_label": "y", "unit": "", "x_min": 0, "x_max": 1,
            "y_min": 0, "y_max": 1, "maps": fields}


class Drawn(unittest.TestCase):
    def draw(self, function, what):
        figures = []
        saved, pictures.save = pictures.save, lambda figure, folder, name: figures.append(figure)
        try:
            function(what, pathlib.Path("."))
        finally:
            pictures.save = saved
        self.addCleanup(pictures.plt.close, figures[0])
        figures[0].canvas.draw()
        return figures[0]

    def test_text_stays_what_it_is(self):
        title = "rough_afm {pressure} & 'quotes' \\ ~ $p$"
        figure = self.draw(pictures.draw_chart, a_chart([{"x": [0, 1], "y": [0, 1]}], title=title))
        self.assertIn(title, [text.get_text() for text in figure.texts])

    def test_fitted_order(self):
        log = axis(logarithmic=True)
        for x, y in (([0.1, 0.2, 0.3, 0.4, 0.5], [0.01, 0.04, 0.09, 0.16, 0.25]), ([4, 8, 16, 32], [n ** -2 for n in (4, 8, 16, 32)])):
            figure = self.draw(pictures.draw_chart, a_chart([{"x": x, "y": y, "fit_order": True}], x=log, y=log, slope_triangle=2))
            self.assertEqual(figure.axes[0].get_legend_handles_labels()[1], ["force, order 2.00 of the last three"])
            triangle = figure.axes[0].patches[0].get_xy()
            (a, left), (b, right) = triangle[0], triangle[1]
            self.assertAlmostEqual(abs(math.log(right / left) / math.log(b / a)), 2)

    def test_ranges_and_powers(self):
        figure = self.draw(pictures.draw_chart, a_chart([{"x": [0, 1], "y": [1e6, 2e6]}], y=axis(label="p", unit="MPa", min=0)))
        self.assertEqual(figure.axes[0].get_xlim()[0], 0)
        self.assertEqual(figure.axes[0].get_ylim()[0], 0)
        self.assertEqual(figure.axes[0].get_ylabel(), "p [10⁶ MPa]")
        self.assertAlmostEqual(figure.axes[0].get_ylim()[1], 2.12)  # a margin of what is seen, from 0 to 2

    def test_equal_numbers_are_drawn_as_equal(self):
        for pressure in ([13.4494651, 13.4494701, 13.4494601], [1, 1, 1], [0, 0, 0], [-2, -2, -2]):
            figure = self.draw(pictures.draw_chart, a_chart([{"x": [0, 1, 2], "y": pressure}]))
            low, high = figure.axes[0].get_ylim()
            self.assertGreaterEqual(high - low, 0.1 * max(map(abs, pressure)))
            self.assertTrue(low < min(pressure) and max(pressure) < high)
            self.assertEqual(figure.axes[0].yaxis.get_major_formatter().get_offset(), "")

    def test_one_number_is_not_on_the_border_of_an_axis_from_zero(self):
        figure = self.draw(pictures.draw_chart, a_chart([{"x": [0.135, 0.135 + 1e-12], "y": [1, 2]}], x=axis(min=0)))
        self.assertEqual(figure.axes[0].get_xlim()[0], 0)
        self.assertGreater(figure.axes[0].get_xlim()[1], 0.14)

    def test_markers_on_a_border_are_whole_and_others_cut(self):
        figure = self.draw(pictures.draw_chart, a_chart([{"x": [0, 1], "y": [1, 2]}, {"x": [0, 1], "y": [1, 5]}], y=axis(max=2.5)))
        self.assertEqual([line.get_clip_on() for line in figure.axes[0].lines], [False, True])

    def test_maps_with_blanks_and_a_clipped_peak(self):
        values = [0, 1, 2, 3, 4, 1000]
        figure = self.draw(pictures.draw_maps, maps_of([a_map(values, blank_zero=True, clip=0.8, at_nodes=True),
                                                        a_map([7] * 6, palette="diverging")]))
        first, second = (axes for axes in figure.axes if axes.images)
        self.assertEqual(first.images[0].get_clim(), (0, 4))
        self.assertTrue(first.images[0].get_array().mask[0, 0])
        self.assertEqual(first.get_xlim(), (-0.25, 1.25))  # 3 columns from 0 to 1: the outer ones centred on the border
        self.assertEqual(second.get_xlim(), (0, 1))
        self.assertEqual(second.images[0].get_clim(), (-7, 7))
        self.assertTrue(any("peak 1000" in text.get_text() for text in figure.texts))

    def test_notes_under_maps_do_not_meet(self):
        field = a_map([-123.4, 1, 2, 3, 4, -1234.5], clip=0.6)
        figure = self.draw(pictures.draw_maps, maps_of([field, {**field, "blank_zero": True}, field]))
        notes = [text.get_window_extent() for text in figure.texts if (text.get_gid() or "").startswith("note_")]
        self.assertEqual(len(notes), 3)
        for left, right in zip(notes, notes[1:]):
            self.assertLess(left.x1, right.x0)
        self.assertGreaterEqual(notes[0].x0, 0)
        self.assertLessEqual(notes[2].x1, figure.bbox.x1)

    def test_surface_in_space_shows_what_fails(self):
        points = [[x, y, 0.01 * x * y] for s in range(2) for y in (0, 1) for x in (s, s + 0.5, s + 1)]
        surface = {"name": "s", "title": "t", "subtitle": "2 segments", "unit": "", "dimension": 3, "columns": 3, "rows": 2,
                   "enriched": sum(points, []), "base": [], "height": [p[2] for p in points], "wrong": [False, True],
                   "places": [{"x": 1, "y": 0, "z": 0, "label": "edge height 0.01 mm", "wrong": True}]}
        figure = self.draw(pictures.draw_surface, surface)
        words = " ".join(text.get_text() for text in figure.texts)
        self.assertIn("2 segments; those in red fail; heights drawn 20 times", words)
        self.assertIn("1   edge height 0.01 mm", words)
        colors = figure.axes[0].collections[0].get_facecolor()
        self.assertEqual(len(colors), 4)
        red = [color[0] > 3 * max(color[1], color[2]) for color in colors]
        self.assertEqual(sum(red), 2)

    def test_a_plane_section_has_a_red_line_beside_the_dark_one(self):
        line = [v for s in range(2) for x in (s, s + 1) for v in (x, 0.1)]
        surface = {"name": "s", "title": "t", "subtitle": "", "unit": "", "dimension": 2, "columns": 2, "rows": 1, "enriched": line,
                   "base": line, "height": [], "wrong": [False, True], "places": []}
        figure = self.draw(pictures.draw_surface, surface)
        labels = figure.axes[0].get_legend_handles_labels()[1]
        self.assertEqual(labels, ["segment ρ", "enriched surface ρₑ = ρ + h n", "segments that fail"])


class Charts(unittest.TestCase):
    @staticmethod
    def work(runs):
        base = {"tangent": "consistent", "counted": False, "slave_mesh": "m", "divisions": 1, "contact_cpu": 0.01, "iterations": 3,
                "block_dofs": 9, "master_dofs": 0, "name": "a run", "segments": 1}
        return {"title": "t", "asked": 0.01, "families": [[0, "enriched"], [3, "plain"]], "runs": [{**base, **run} for run in runs]}

    def test_numbers_of_the_axis_stay_in_the_picture(self):
        for k in range(20):  # wherever the last tic is
            largest = 2e-4 * 1.125 ** k
            work = self.work([{"family": 3, "error": 0.1, "cpu": 0.3 * largest}, {"family": 0, "error": 0.01, "cpu": largest}])
            figure, axes = pictures.plt.subplots(figsize=(440 / 72, 304 / 72))
            figure.subplots_adjust(left=68 / 440, right=1 - 26 / 440, top=1 - 14 / 304, bottom=50 / 304)
            chart.work_panel(axes, work, "cpu")
            figure.canvas.draw()
            shown = [label.get_window_extent() for label in axes.get_xticklabels() if label.get_text()]
            self.assertGreaterEqual(len(shown), 2)
            self.assertLessEqual(shown[-1].x1, figure.bbox.x1 + 0.1)
            for left, right in zip(shown, shown[1:]):
                self.assertLess(left.x1, right.x0)
            pictures.plt.close(figure)

    def test_the_front_has_no_run_that_another_beats(self):
        work = self.work([{"family": 3, "error": 0.1, "cpu": 1}, {"family": 3, "error": 0.02, "cpu": 3},
                          {"family": 0, "error": 0.01, "cpu": 2}, {"family": 3, "error": 0, "cpu": 9}])
        self.assertEqual(chart.front(work["runs"], "cpu"), [work["runs"][0], work["runs"][2]])

    def test_marks_say_their_numbers(self):
        work = self.work([{"family": 3, "error": 0.1, "cpu": 1}, {"family": 0, "error": 0.01, "cpu": 2, "counted": True}])
        svg = chart.work_svg(work, "cpu")
        self.assertEqual(svg.count("<title>a run: error "), 2)
        self.assertIn("error 10 %, 1.0 s, contact 10 ms, 9 dofs, 3 iterations", svg)
        for outside in ("http:", "https:", "url(", "src="):
            self.assertNotIn(outside, svg)

    def test_the_truth_has_a_line_for_each_method(self):
        work = {**self.work([]), "sentence": "plain is the fastest.", "methods": [
            {"method": "plain", "asked": 0.01, "reached": True, "segments": 64, "dofs": 60, "cpu": 2, "best_error": 0.005},
            {"method": "enriched", "asked": 0.01, "reached": False, "segments": 1, "dofs": 50, "cpu": 4, "best_error": 0.02}]}
        text = chart.truth_section([work])
        self.assertIn("<td>plain</td><td>yes</td><td>64</td><td>60</td><td>2.0</td>", text)
        self.assertIn("<td>no:\u00a02\u00a0%</td>", text)
        self.assertIn("<li><b>t:</b> plain is the fastest.</li>", text)

    def test_cells_have_colour_letter_and_words(self):
        chart.ENDS.update({"rho_e folds": chart.LETTERS[0]})
        panel = {"surface": "s", "projection": "p", "tangent": "t", "rules": True, "fate": ["solved", "flagged", "flagged", "silently wrong"],
                 "end": ["solved", "rho_e folds", "status", "solved"], "status": [0, 0, 6, 0], "iterations": [40, 0, 3, 5]}
        self.assertEqual([chart.look(panel, k)[1] for k in range(4)], ["", "F", "6", "W"])
        axes = {"label": "x", "values": [1, 2]}
        svg = chart.panel_svg({"title": "t", "x": axes, "y": axes}, panel)
        self.assertEqual(svg.count("<title>"), 4)
        self.assertIn("1.00, 2.00: flagged: status 6, 3 iterations", svg)

    def test_numbers_as_in_tables(self):
        for value, digits, text in ((0.0123, 2, "0.012"), (2, 2, "2.0"), (95.4, 2, "95"), (1234567, 2, "1.2e+06"), (1e-4, 3, "1.00e-04")):
            self.assertEqual(chart.number(value, digits), text)


if __name__ == "__main__":
    unittest.main()
