"""The commands of the `lab` program inside the lab: watch, status, hint, check, submit, …"""
