"""Questions that a test answers beforehand."""

from __future__ import annotations

from bobdesk.ui.questions import Questions


class Answers(Questions):
    """Answers what a test tells it to, and remembers what was asked."""

    def __init__(self, settings, window):
        super().__init__(settings, window)
        self.asked = []
        self.save_answer = "cancel"
        self.changed_answer = "cancel"
        self.copy_answer = False
        self.overwrite_answer = False
        self.save_path = None
        self.open_path = None
        self.plan_answer = "cancel"
        self.stop_answer = False
        self.open_paths = []

    def save_changes(self, name):
        self.asked.append("save changes")
        return self.save_answer

    def changed_on_disk(self, name):
        self.asked.append("changed on disk")
        return self.changed_answer

    def open_elsewhere(self, name):
        self.asked.append("open elsewhere")
        return self.copy_answer

    def overwrite(self, name):
        self.asked.append("overwrite")
        return self.overwrite_answer

    def file_to_save(self, purpose, title, name, filters, suffix):
        self.asked.append("where")
        return self.save_path

    def file_to_open(self, purpose, title, filters):
        self.asked.append("which")
        return self.open_path

    def stop_work(self, text, consequence):
        self.asked.append("stop")
        return self.stop_answer

    def files_to_open(self, purpose, title, filters):
        self.asked.append("which ones")
        return self.open_paths

    def where_to_put_plan(self, name, *, is_meant=True):
        self.asked.append("where to put the plan")
        return self.plan_answer
