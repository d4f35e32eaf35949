"""The files of a new ament_python package, as ros2cli makes them since 0.32.6 (jazzy).

Before that, setup.py had ``tests_require``, which setuptools has dropped (ros2cli#1066).
"""

from .linter_tests import linter_tests
from .manifest import PackageDescription
from .writing import create_folder, write_file

_SETUP_PY = """\
from setuptools import find_packages, setup

package_name = '{name}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='{maintainer}',
    maintainer_email='{email}',
    description='{description}',
    license='{license}',
    extras_require={{
        'test': [
            'pytest',
        ],
    }},
    entry_points={{
        'console_scripts': [
{script}        ],
    }},
)
"""
_SETUP_CFG = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""
_NODE = """\
def main():
    print('Hi from {name}.')


if __name__ == '__main__':
    main()
"""


def populate_ament_python(package: PackageDescription, folder: str) -> None:
    """Write everything except package.xml and LICENSE.

    Raises OSError if a file cannot be written.
    """
    print("creating source folder")
    source = create_folder(f"{folder}/{package.name}")
    write_file(f"{folder}/setup.py", setup_py(package))
    write_file(f"{folder}/setup.cfg", _SETUP_CFG.format(name=package.name))
    resource = create_folder(f"{folder}/resource")
    write_file(f"{resource}/{package.name}", "")
    write_file(f"{source}/__init__.py", "")
    test = create_folder(f"{folder}/test")
    for name, text in linter_tests(kilted=package.kilted).items():
        write_file(f"{test}/{name}", text)
    if package.node_name:
        write_file(f"{source}/{package.node_name}.py", _NODE.format(name=package.name))
    if package.library_name:
        library = create_folder(f"{source}/{package.library_name}")
        write_file(f"{library}/__init__.py", "")


def setup_py(package: PackageDescription) -> str:
    """Return the text of setup.py; nothing is escaped, as in ros2."""
    node, name = package.node_name, package.name
    return _SETUP_PY.format(
        name=name,
        maintainer=package.maintainer,
        email=package.email,
        description=package.description,
        license=package.license,
        script=f"            '{node} = {name}.{node}:main'\n" if node else "",
    )
