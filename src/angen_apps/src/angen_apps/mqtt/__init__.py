"""angen mqtt: the building on an MQTT broker, for Home Assistant, Node-RED and other programs."""
