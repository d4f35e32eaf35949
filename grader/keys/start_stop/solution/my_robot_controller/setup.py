"""What is installed, and which executables the package offers."""

from setuptools import find_packages
from setuptools import setup

package_name = 'my_robot_controller'

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
    maintainer='student',
    maintainer_email='student@todo.todo',
    description='A node that starts and stops a turtle',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'start_stop = my_robot_controller.start_stop:main',
        ],
    },
)
