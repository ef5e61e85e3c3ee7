# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that run jobs: step by step with a window, so that Esc stops them; all at once without one."""

from __future__ import annotations

from pathlib import Path

import bpy

from . import jobs
from .frames import first_frame, show
from .program import Installation, Job, ProgramError, find_program
from .properties import catalogue, preferences

FAULTS = (ProgramError, ValueError, OSError, RuntimeError)


def found_program(context: bpy.types.Context) -> Installation:
    """The program of the preferences, which are updated. ProgramError if there is none."""
    said = preferences(context)
    found = find_program(bpy.path.abspath(said.program))
    said.home, said.version = str(found.home), found.version
    return found


class FindProgram(bpy.types.Operator):
    """Find the program veldt, and read what things, materials and cameras it knows"""

    bl_idname = "veldt.find_program"
    bl_label = "Find Program"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Find it."""
        try:
            found = found_program(context)
        except ProgramError as error:
            said = preferences(context)
            said.home = said.version = ""
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"veldt {found.version}: {found.path}")
        return {"FINISHED"}


class JobOperator(bpy.types.Operator):
    """Base of operators that run a job; they define `job`."""

    _job: Job
    _timer: bpy.types.Timer | None = None

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Whether no other job runs."""
        return not context.window_manager.veldt.is_running

    def job(self, context: bpy.types.Context) -> Job:
        """The job to run."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Run all of it."""
        try:
            self._job = self.job(context)
            while True:
                _show_progress(context, next(self._job))
        except StopIteration as end:
            return self._finish(context, end.value)
        except FAULTS as error:
            return self._fail(context, error)

    def invoke(self, context: bpy.types.Context, _) -> set[str]:
        """Run it step by step, beside the window."""
        if bpy.app.background:
            return self.execute(context)
        try:
            self._job = self.job(context)
        except FAULTS as error:
            return self._fail(context, error)
        manager = context.window_manager
        manager.veldt.is_running = True
        self._timer = manager.event_timer_add(0.05, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take a step. Other events are blocked, because the scene must not change meanwhile."""
        if event.type == "ESC":
            self._job.close()
            return self._end(context, {"CANCELLED"}, "Stopped", is_error=True)
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            _show_progress(context, next(self._job))
        except StopIteration as end:
            return self._finish(context, end.value)
        except FAULTS as error:
            return self._fail(context, error)
        return {"RUNNING_MODAL"}

    def _finish(self, context: bpy.types.Context, said: str) -> set[str]:
        self.report({"INFO"}, said)
        return self._end(context, {"FINISHED"}, said.splitlines()[0] if said else "Done", is_error=False)

    def _fail(self, context: bpy.types.Context, error: Exception) -> set[str]:
        self.report({"ERROR"}, str(error))
        return self._end(context, {"CANCELLED"}, str(error), is_error=True)

    def _end(self, context: bpy.types.Context, how: set[str], message: str, is_error: bool) -> set[str]:
        manager = context.window_manager
        if self._timer is not None:
            manager.event_timer_remove(self._timer)
        said = manager.veldt
        said.is_running, said.progress, said.message, said.is_error = False, 0, message, is_error
        return how


def _show_progress(context: bpy.types.Context, progress) -> None:
    said = context.window_manager.veldt
    said.progress, said.message, said.is_error = progress.fraction, progress.text, False
    for area in context.screen.areas if context.screen else ():
        area.tag_redraw()


def _request(context: bpy.types.Context) -> jobs.Request:
    return jobs.request_of(context.scene, context.view_layer, catalogue(context))


class RenderPasses(JobOperator):
    """Render object indices, depth and normals of this scene with Cycles. The scene stays as it is"""

    bl_idname = "veldt.render_passes"
    bl_label = "Render Passes"

    def job(self, context: bpy.types.Context) -> Job:
        """Render."""
        found_program(context)
        return jobs.render_passes(_request(context))


class Convert(JobOperator):
    """Turn the passes into thermal frames and labels"""

    bl_idname = "veldt.convert"
    bl_label = "Convert"

    def job(self, context: bpy.types.Context) -> Job:
        """Convert."""
        return jobs.convert(_request(context), found_program(context).path)


class MakeDataset(JobOperator):
    """Render passes of this scene, and turn them into thermal frames and labels"""

    bl_idname = "veldt.make_dataset"
    bl_label = "Make Dataset"

    def job(self, context: bpy.types.Context) -> Job:
        """Render and convert."""
        found = found_program(context)
        return jobs.make_dataset(_request(context), found.path)


class Generate(JobOperator):
    """Make a dataset of a config; the scene has no part in it"""

    bl_idname = "veldt.generate"
    bl_label = "Generate from Config"

    def job(self, context: bpy.types.Context) -> Job:
        """Generate."""
        said = context.scene.veldt
        if not said.config:
            raise ValueError("config is missing; expected a file")
        out = Path(bpy.path.abspath(said.out)) / "generated"
        return jobs.generate(found_program(context).path, bpy.path.abspath(said.config), out, said.engine)


class ShowFrames(bpy.types.Operator):
    """Show the 8-bit frames as a sequence in an image editor"""

    bl_idname = "veldt.show_frames"
    bl_label = "Show Frames"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show them."""
        out = Path(bpy.path.abspath(context.scene.veldt.out))
        try:
            image = show(context, first_frame(out))
        except FAULTS as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{image.name}: {image.filepath}")
        return {"FINISHED"}


CLASSES = (FindProgram, RenderPasses, Convert, MakeDataset, Generate, ShowFrames)
