"""The page's texts, by the names that its files use."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.base.i18n.translator import translated
from lab.window.work_texts import WORK_TEXTS

TEXTS = {
    # the frame
    "title": msg("ROS 2 lab"),
    "views": msg("Views"),
    "connecting": msg("connecting"),
    "connected": msg("connected"),
    "lost": msg("connection lost"),
    "lost_long": msg(
        "The window does not answer. If you ended it, start it again and open the new address."
    ),
    "bridge_ended": msg("ROS connection restarts"),
    "bridge_failed": msg("The program that talks to ROS does not start. It printed:"),
    # the turtle
    "turtle": msg("Turtle"),
    "field": msg("Field of the turtles"),
    "choose_turtle": msg("Turtles"),
    "drive": msg("Drive"),
    "keys": msg(
        "The arrow keys drive the chosen turtle with 2 m/s and 2 rad/s. A command holds for one "
        "second. The space bar stops the turtle."
    ),
    "forward": msg("Forward"),
    "back": msg("Back"),
    "left": msg("Turn left"),
    "right": msg("Turn right"),
    "stop": msg("Stop"),
    "traces_here": msg(
        "The lines show where a turtle moved while this page was open. Topics do not tell the colour "
        "of its pen, so each turtle has a colour of its own here."
    ),
    "clear": msg("Clear the lines on this page"),
    "no_turtle": msg(
        "There is no turtle yet. Start it in a terminal: ros2 run turtlesim turtlesim_node"
    ),
    "pose": msg("x {x} m, y {y} m, θ {theta} rad"),
    "speed": msg("{linear} m/s, {angular} rad/s"),
    # the graph
    "graph": msg("Graph"),
    "graph_drawing": msg("Drawing of the graph"),
    "services": msg("Services and actions"),
    "plumbing": msg("/rosout, /parameter_events and hidden nodes"),
    "node": msg("Node"),
    "topic": msg("Topic"),
    "service": msg("Service"),
    "action": msg("Action"),
    "misfit": msg("does not fit"),
    "problems": msg("Problems"),
    "no_problem": msg("Everything that is connected fits."),
    "graph_empty": msg("There is no node yet. Start one with ros2 run."),
    "twice": msg("Two nodes are called {node}. Give one of them another name."),
    "no_message": msg("{subscriber} gets no messages from {publisher} on {topic}: {reasons}"),
    "no_answer_from": msg("{client} cannot call {service} on {server}: {reasons}"),
    "misfit_type": msg("type {offered} is not {requested}"),
    "misfit_definition": msg("both types have the same name, but different fields"),
    "misfit_reliability": msg("reliability: it asks for {requested}, but {offered} is offered"),
    "misfit_durability": msg("durability: it asks for {requested}, but {offered} is offered"),
    "misfit_liveliness": msg("liveliness: it asks for {requested}, but {offered} is offered"),
    "misfit_deadline": msg(
        "deadline: it asks for a message every {requested}, but {offered} is offered"
    ),
    "misfit_lease": msg("liveliness lease: it asks for {requested}, but {offered} is offered"),
    "misfit_other": msg("QoS: {offered}"),
    "short_type": msg("type"),
    "short_definition": msg("definition"),
    "short_qos": msg("QoS: {policy}"),
    "policy_reliability": msg("reliability"),
    "policy_durability": msg("durability"),
    "policy_liveliness": msg("liveliness"),
    "policy_deadline": msg("deadline"),
    "policy_lease": msg("liveliness lease"),
    "policy_other": msg("other"),
    "reliable": msg("reliable"),
    "best_effort": msg("best effort"),
    "transient_local": msg("transient local"),
    "volatile": msg("volatile"),
    "automatic": msg("automatic"),
    "manual_by_topic": msg("manual by topic"),
    "infinite": msg("infinite"),
    "unknown": msg("unknown"),
    "type": msg("Type"),
    "publishers": msg("Publishers"),
    "subscriptions": msg("Subscriptions"),
    "publishes": msg("Publishes"),
    "subscribes": msg("Subscribes to"),
    "servers": msg("Servers"),
    "clients": msg("Clients"),
    "offers": msg("Offers"),
    "calls": msg("Calls"),
    "none": msg("none"),
    "plot_this": msg("Plot a field of it"),
    "see_parameters": msg("Show its parameters"),
    # the log
    "log": msg("Log"),
    "log_lines": msg("Log lines"),
    "level": msg("Level, at least"),
    "from_node": msg("Node"),
    "containing": msg("Text"),
    "all_nodes": msg("all nodes"),
    "log_clear": msg("Clear"),
    "log_count": msg("{shown} of {all} lines"),
    "log_empty": msg("No node has logged anything yet."),
    # plots
    "plot": msg("Plot"),
    "field_of_topic": msg("Field"),
    "add": msg("Add"),
    "remove": msg("Remove {series}"),
    "span": msg("Seconds"),
    "pause": msg("Pause"),
    "chart": msg("Chart of the values over time"),
    "plot_hint": msg("Choose a topic and a field, then Add."),
    "plot_seeks": msg(
        "Nothing moves yet. The plot begins with the first number that changes. Or choose a topic and "
        "a field, then Add."
    ),
    "logged_number": msg("number in the lines of {node}"),
    "plot_no_topic": msg("no topic"),
    "no_number": msg("no numeric field"),
    "not_installed": msg(
        "The type of this topic is not installed here. If it is your own, build it with colcon build, "
        "then load it."
    ),
    "restart": msg("Load my interfaces"),
    "no_value": msg("no message yet"),
    # parameters
    "parameters": msg("Parameters"),
    "no_parameters": msg("There is no node with parameters yet."),
    "name": msg("Name"),
    "value": msg("Value"),
    "description": msg("Description"),
    "set": msg("Set"),
    "set_label": msg("Set {name}"),
    "was_set": msg("{name} is set."),
    "not_set": msg("{name} is not set: {reason}"),
    "wrong_value": msg("this is not a value of type {type}"),
    "no_answer": msg("The node does not answer. Is it spinning?"),
    "read_only": msg("read-only"),
    "range": msg("{from} to {to}"),
}


def page_texts(lang: str, *, has_turtlesim: bool = True, has_lab: bool = False) -> dict[str, str]:
    """Return the page's texts in a language, and the language itself as `lang`.

    `has_turtlesim` is "" where there is none to start: the page shows no turtles then. `has_lab` is
    "" outside of a lab: the page has only what nodes show then.
    """
    own = {
        "lang": lang,
        "has_turtlesim": "yes" if has_turtlesim else "",
        "has_lab": "yes" if has_lab else "",
    }
    return own | {name: translated(text, lang) for name, text in (TEXTS | WORK_TEXTS).items()}
