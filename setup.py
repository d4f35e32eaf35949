"""The ament_python package ros2_teaching_lab: colcon builds it like any other."""

from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "ros2_teaching_lab"
COURSE = Path("lab/course")

# the course content is data, found in the share folder as ROS packages have it
course = {}
for file in sorted(COURSE.rglob("*")):
    if file.is_file() and "__pycache__" not in file.parts:
        course.setdefault(f"share/{PACKAGE}/{file.parent.relative_to('lab')}", []).append(str(file))

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(include=["grader", "grader.*"]),
    include_package_data=True,
    package_data={
        "": ["*.toml", "*.json", "*.txt", "*.in"],
        "grader": ["keys/*/*.yaml"],  # hidden checks and mutants: data, no package
        "grader.base.i18n": ["*/LC_MESSAGES/*.mo"],
        "grader.publish.pages": ["templates/*"],
        "grader.ros": ["locks/*", "*.cmake", "interface_texts/*/*/*"],
        "grader.ros.ros2_command": ["licenses/*", "*.xml"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        *course.items(),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="The maintainers",
    maintainer_email="maintainers@users.noreply.h-seed-bdf1a219.example",
    description="A ROS 2 teaching lab, and the autograder that marks its exercises.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"], "cluster": ["distributed"]},
    entry_points={
        "console_scripts": ["grader = grader.cli.main:main"],
        "ros2cli.command": [
            "lab = grader.cli.ros2cli_extensions:LabCommand",
            "grade = grader.cli.ros2cli_extensions:GradeCommand",
        ],
    },
)
