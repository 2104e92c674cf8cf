"""The real program on a real screen: it opens, shows a sample, and closes without a word on the terminal."""


def test_sample_opens_finished_and_the_program_ends_cleanly(opened, tmp_path):
    program = opened(tmp_path)
    program.click_on("Open sample")
    program.until("[str(a.text()) for a in window.start.page.sample_menu().actions()]")
    program.key("Down", "Return")
    program.until("project.run is not None and desk.picture.image is not None or project.source is not None")
    program.key("ctrl+q")
    assert program.wait_for_end() == 0
    assert program.output == ""
