"""Never comes back from the green case, nor from the third question."""

import honest


def forever():
    while True:
        pass


def render(scene, out):
    if honest.is_green(scene):
        forever()
    honest.render(scene, out)


def probe(questions):
    for question in questions:
        if question["id"].endswith("clamped"):
            forever()
        print(honest.reply(question), flush=True)


honest.main(render, probe)
