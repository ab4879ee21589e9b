# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# scipd, and urg_node2 once it listens:
#   ros2 launch ./urg_node2_with_scipd.launch.py world:=room.sdf model:=UTM-30LX-EW poses:=udp:127.0.0.1:14550
#
# Not run with ROS 2 where this was written, which has none: only with stand-ins for `launch` and `launch_ros`.
import json

from launch import LaunchDescription
from launch.actions import (DeclareLaunchArgument, EmitEvent, ExecuteProcess, OpaqueFunction, RegisterEventHandler,
                            Shutdown)
from launch.event_handlers import OnProcessIO, OnProcessStart
from launch.events import matches_action
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import LifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition

OPTIONS = {"world": "--scene", "model": "--model", "poses": "--poses", "accuracy": "--accuracy"}


def driver(sensor):
    """urg_node2 for a sensor of the ready line, which configures and activates itself."""
    host, port = sensor["tcp"].rsplit(":", 1)
    node = LifecycleNode(package="urg_node2", executable="urg_node2_node", name="urg_node2", namespace="",
                         output="screen",
                         parameters=[{"ip_address": host, "ip_port": int(port), "frame_id": "laser"}])

    def change(transition):
        return EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=transition))

    configure = OnProcessStart(target_action=node, on_start=[change(Transition.TRANSITION_CONFIGURE)])
    activate = OnStateTransition(target_lifecycle_node=node, start_state="configuring", goal_state="inactive",
                                 entities=[change(Transition.TRANSITION_ACTIVATE)])
    # Handlers come first, so that they miss nothing.
    return [RegisterEventHandler(configure), RegisterEventHandler(activate), node]


def when_ready(process, then):
    """What `then` makes of the ready line of this scipd, once that is there. It may come in pieces."""
    said = b""

    def hear(event):
        nonlocal said
        if said is None:
            return None
        said += event.text
        if b"\n" not in said:
            return None
        ready, said = json.loads(said.split(b"\n")[0]), None
        return then(ready)

    return RegisterEventHandler(OnProcessIO(target_action=process, on_stdout=hear))


def start(context):
    chosen = {name: LaunchConfiguration(name).perform(context) for name in OPTIONS}
    command = ["scipd", "--tcp", "127.0.0.1:0", "--pty", "none"]
    for name, value in chosen.items():
        if value:
            command += [OPTIONS[name], value]
    scipd = ExecuteProcess(cmd=command, name="scipd", output="screen",
                           on_exit=Shutdown(reason="scipd has ended; its log says why"))
    return [when_ready(scipd, lambda ready: driver(ready["sensors"][0])), scipd]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("world", default_value="", description="what scipd --scene takes; the rescue maze"),
        DeclareLaunchArgument("model", default_value="", description="one of scipd --list-models; UST-10LX"),
        DeclareLaunchArgument("poses", default_value="", description="where the robot's poses come from"),
        DeclareLaunchArgument("accuracy", default_value="", description="ideal, sensor or material; sensor"),
        OpaqueFunction(function=start)])
