// Nobody lists this room.
