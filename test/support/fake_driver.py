"""A driver without samples, which answers as it was told: `python -m support.fake_driver NAMESPACE HOW`.

`obeys`; `refuses` to switch the gyro off; `cannot` leave it to its sensor; `sleeps` five seconds over every call;
`dies` in the call that switches it off. It says on, off and swings, a line a call, as it is asked.
"""

import os
import sys
import time

import rclpy

from pdr_msgs.srv import SetGyroPower, SetSampleRate

RATE_HZ, SLEEP_S = 200.0, 5.0


def main() -> None:
    namespace, how = sys.argv[1:]
    rclpy.init()
    node = rclpy.create_node("fake_driver", namespace=namespace)

    def set_gyro_power(request, response):
        print("swings" if request.on_motion else "on" if request.powered else "off", flush=True)
        if how == "sleeps":
            time.sleep(SLEEP_S)
        if how == "dies" and not request.powered:
            os._exit(1)
        response.success = not (request.on_motion if how == "cannot" else how == "refuses" and not request.powered)
        response.message = "" if response.success else "not today"
        response.settling_time = 0.05
        return response

    def set_sample_rate(request, response):
        response.success, response.rate = True, min(request.rate, RATE_HZ)
        return response

    node.create_service(SetGyroPower, "set_gyro_power", set_gyro_power)
    node.create_service(SetSampleRate, "set_sample_rate", set_sample_rate)
    rclpy.spin(node)


if __name__ == "__main__":
    main()
