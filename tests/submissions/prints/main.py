"""Prints on standard output before its picture, and between its answers."""

import honest


def render(scene, out):
    print("rendering <b>now</b>")
    honest.render(scene, out)


def probe(questions):
    for question in questions:
        print("thinking about", question["id"])
        print(honest.reply(question), flush=True)


honest.main(render, probe)
