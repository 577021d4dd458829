"""Lets catkin put the angen_apps package on the Python path; not to be called by hand."""
from pathlib import Path

from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

source = str(Path(__file__).resolve().parent / 'src')
setup(**generate_distutils_setup(packages=find_packages(source), package_dir={'': 'src'},
                                 package_data={'angen_apps': ['py.typed'],
                                               'angen_apps.walktest': ['standards/*.yaml'],
                                               'angen_apps.situations': ['*.yaml'],
                                               'angen_apps.mqtt': ['*.yaml'],
                                               'angen_apps.residents': ['*.yaml',
                                                                        'profiles/*.yaml']}))
