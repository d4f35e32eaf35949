"""The catalogue: the world, files, the ROS graph and actions, as a run shows them."""

from __future__ import annotations

from grader.base.i18n.message import msg
from grader.mistakes import links
from grader.mistakes.kind import Family, Step
from grader.package.source.follows_already import calls, names, never

ENDS = msg(
    "The callback of an action decides how the goal ends: it calls succeed(), abort() or canceled() "
    "on the goal handle, and returns the result. Without a call, the goal is aborted."
)
SLEEPS = msg(
    "time.sleep() waits in wall time. All times here are ROS time, which /clock shows: with "
    "use_sim_time it can pass faster or more slowly than wall time. While the callback sleeps in the "
    "only thread of the node, no other callback runs."
)
SLEEP_FOR = msg(
    "Wait in ROS time: self.get_clock().sleep_for(Duration(seconds=…)) in place of time.sleep(…), "
    "with Duration from rclpy.duration, and spin the node with a MultiThreadedExecutor and the "
    "action's callbacks in a ReentrantCallbackGroup."
)
SLEEP_STEPS = (
    Step(
        msg(
            "Wait in ROS time: self.get_clock().sleep_for(Duration(seconds=…)) in place of "
            "time.sleep(…), with Duration from rclpy.duration."
        ),
        never,
    ),
    Step(msg("Spin the node with a MultiThreadedExecutor."), calls("MultiThreadedExecutor")),
    Step(
        msg("Put the action's callbacks in a ReentrantCallbackGroup."),
        calls("ReentrantCallbackGroup"),
    ),
)
CANCEL_STEPS = (
    Step(msg("Pass a cancel_callback to the ActionServer of {service}."), names("cancel_callback")),
    Step(msg("Return CancelResponse.ACCEPT in the cancel callback."), names("ACCEPT")),
    Step(
        msg("Check goal_handle.is_cancel_requested while the goal runs."),
        names("is_cancel_requested"),
    ),
    Step(msg("Call goal_handle.canceled() before you return."), calls("canceled")),
)
PUBLISH_FEEDBACK = msg(
    "Call goal_handle.publish_feedback(…) in the callback of {service}, while it works."
)
CALL_ASYNC = msg(
    "Send the request with self.client_.call_async(request), with parentheses, when it is due."
)
_action = Family("action", links.ACTIONS)
_graph = Family("graph", links.NODES)
_world = Family("world", links.TOPICS)
_files = Family("files", links.PACKAGE)
KINDS = (
    _world(
        "other_state",
        "world",
        msg("The world is in another state"),
        msg(
            "The world publishes {topic}, not the node: it shows what came of the node's commands."
        ),
        msg("Look at what the node sends to the world up to that time, and correct that."),
    ),
    _world(
        "off_path",
        "world",
        msg("The turtle drives another way"),
        msg(
            "With a speed v and a turning speed w, a robot drives on a circle with the radius v / w."
        ),
        msg("Choose angular.z so that linear.x divided by angular.z is {radius}."),
    ),
    _world(
        "stands_still",
        "world",
        msg("The turtle does not move"),
        msg(
            "A velocity command holds for one second. Without a new one, and with a speed of 0, the "
            "turtle stands still."
        ),
        msg("Publish a velocity for {turtle} again and again, with linear.x above 0."),
    ),
    _world(
        "hits_wall",
        "world",
        msg("The turtle hits the wall"),
        msg(
            "The turtle goes on with its last command until the next one comes, for up to a second: it "
            "has to turn early enough before the wall."
        ),
        msg("Turn earlier, or drive more slowly near the wall."),
        whys={"straight": msg("No message asked for a turn until then: angular.z was 0 in all.")},
        fixes={
            "straight": msg(
                "Set angular.z when a wall is near. If a line does so, look at the condition above it."
            )
        },
    ),
    _world(
        "too_short",
        "world",
        msg("The turtle drives too little"),
        msg(
            "A velocity command holds for one second. Without a new one, and while it only turns, the "
            "turtle does not get ahead."
        ),
        msg("Let {turtle} drive faster, and go on until the end."),
    ),
    _world(
        "one_place",
        "world",
        msg("The turtle stays in one place"),
        msg("A turtle that only turns, or drives in a small circle, sees little of the field."),
        msg("Let {turtle} drive straight on where there is room, and turn only near the wall."),
    ),
    _world(
        "bumps",
        "world",
        msg("It runs into something"),
        msg(
            "What moves goes on with its last command until the next one comes, for up to a second: it "
            "has to stop or turn early enough before an obstacle."
        ),
        msg("Stop or turn {turtle} earlier, or drive more slowly near an obstacle."),
    ),
    _world(
        "too_often",
        "service",
        msg("The service is called too often"),
        msg("Each request that is sent takes effect."),
        msg("Send the request only when it is due."),
    ),
    _world(
        "not_asked",
        "service",
        msg("The service is not called"),
        msg("A client does nothing by itself: each call needs a request that is sent."),
        CALL_ASYNC,
        steps={"": (Step(CALL_ASYNC, calls("call_async")),)},
    ),
    _world(
        "wrong_request",
        "service",
        msg("The request has a different value"),
        msg("Fields of a request that are not set are 0, or empty."),
        msg("Set {field} of the request before call_async()."),
    ),
    _files(
        "missing",
        "file",
        msg("A file is missing"),
        msg("The assignment asks for a file with this name in the package."),
        msg("Create {path} in the package, or rename the file that you have."),
    ),
    _files(
        "no_match",
        "file",
        msg("A file has other text than asked for"),
        msg("The assignment says what must be in this file."),
        msg("Compare {path} with what the assignment asks for."),
    ),
    _graph(
        "node_missing",
        "class",
        msg("A node is not on the ROS graph"),
        msg("A node is on the graph as soon as it is made, under the name that it gets."),
        msg("Make the node {name}, with exactly this name."),
        of_shape=True,
    ),
    _graph(
        "node_twice",
        "class",
        msg("Several nodes have the same name"),
        msg("The name of a node must be unique on the ROS graph: others find it by its name."),
        msg("Make the node {name} once, and give other nodes other names."),
        of_shape=True,
    ),
    _graph(
        "node_unexpected",
        "class",
        msg("There is one node too many"),
        msg("Each object of the class Node is a node of its own on the ROS graph."),
        msg("Make {name} only if the assignment asks for it."),
        of_shape=True,
    ),
    _graph(
        "not_connected",
        "topic",
        msg("Two nodes are not connected"),
        msg(
            "A publisher and a subscription are connected if the topic's name and type are equal on "
            "both sides."
        ),
        msg("Look at {node}: create its publisher or subscription on {topic}."),
        fixes={"type": msg("Use the same type on both sides of {topic}.")},
        of_shape=True,
    ),
    _action(
        "foreign_server",
        "service",
        msg("Another node offers the action too"),
        msg("If two nodes offer an action of one name, a client cannot know which of them acts."),
        msg("Make the ActionServer of {service} in {judged} only; remove it from {node}."),
        of_shape=True,
    ),
    _action(
        "missing",
        "service",
        msg("The node does not offer the action"),
        msg("An action exists as soon as its ActionServer is made; clients find it by its name."),
        msg(
            "Write self.server_ = ActionServer(self, {short}, '{service}', self.execute) in __init__."
        ),
        of_shape=True,
    ),
    _action(
        "wrong_name",
        "service",
        msg("The action has a different name"),
        msg("A client and an action meet if their names are equal, to the letter."),
        msg("Use '{service}' in place of '{name}'."),
        of_shape=True,
    ),
    _action(
        "wrong_type",
        "service",
        msg("The action has a different type"),
        msg("A client and an action of different types never meet."),
        msg("Pass {short} as the second argument of ActionServer."),
        of_shape=True,
    ),
    _action(
        "no_answer",
        "service",
        msg("The action does not answer the goal"),
        msg("ROS asks the goal callback whether to take a goal. It must return at once."),
        msg(
            "Return GoalResponse.ACCEPT or GoalResponse.REJECT in the goal callback of {service}, "
            "without waiting in it."
        ),
    ),
    _action(
        "refused",
        "service",
        msg("The action refuses the goal"),
        msg("The goal callback decides whether a goal is taken; without one, each goal is."),
        msg("Return GoalResponse.ACCEPT in the goal callback of {service} for such a goal."),
    ),
    _action(
        "accepted",
        "service",
        msg("The action takes a goal that it must refuse"),
        msg("The goal callback decides whether a goal is taken; without one, each goal is."),
        msg(
            "Pass goal_callback=… to the ActionServer of {service}, and return GoalResponse.REJECT "
            "in it for such a goal."
        ),
        steps={
            "": (
                Step(
                    msg("Pass goal_callback=… to the ActionServer of {service}."),
                    names("goal_callback"),
                ),
                Step(
                    msg("Return GoalResponse.REJECT in the goal callback for such a goal."),
                    names("REJECT"),
                ),
            )
        },
    ),
    _action(
        "no_feedback",
        "service",
        msg("The action gives no feedback"),
        msg(
            "A client learns how far the goal is from feedback, which the callback has to publish."
        ),
        PUBLISH_FEEDBACK,
        whys={"sleeps": SLEEPS},
        fixes={"sleeps": SLEEP_FOR},
        steps={
            "": (Step(PUBLISH_FEEDBACK, calls("publish_feedback")),),
            "sleeps": SLEEP_STEPS,
        },
    ),
    _action(
        "wrong_feedback",
        "service",
        msg("The feedback has a different value"),
        msg("Fields that are not set are 0, or empty."),
        msg("Set {field} of the feedback each time before publish_feedback()."),
    ),
    _action(
        "no_result",
        "service",
        msg("The goal does not end in time"),
        ENDS,
        msg("Let the callback of {service} return the result when the work is done."),
        whys={"sleeps": SLEEPS},
        fixes={"sleeps": SLEEP_FOR},
        steps={"sleeps": SLEEP_STEPS},
    ),
    _action(
        "wrong_status",
        "service",
        msg("The goal ends in another state"),
        ENDS,
        msg(
            "Let the goal end as {wanted}: call the method of goal_handle for it before you return."
        ),
    ),
    _action(
        "wrong_result",
        "service",
        msg("The action's result has a different value"),
        msg(
            "The callback fills the result and returns it. Fields that are not set are 0, or empty."
        ),
        msg(
            "Look at the lines that set {field} of the result in the callback of {service}, and at what "
            "they make of the goal."
        ),
    ),
    _action(
        "not_cancelled",
        "service",
        msg("The goal cannot be cancelled"),
        msg(
            "A goal is cancelled if the cancel callback accepts it, and if the callback that works on "
            "it looks at is_cancel_requested and calls canceled()."
        ),
        msg(
            "Pass a cancel_callback to the ActionServer of {service} that returns "
            "CancelResponse.ACCEPT, and check goal_handle.is_cancel_requested while the goal runs."
        ),
        whys={"sleeps": SLEEPS},
        fixes={"sleeps": SLEEP_FOR},
        steps={"": CANCEL_STEPS, "sleeps": SLEEP_STEPS},
    ),
)
